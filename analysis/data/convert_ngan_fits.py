#!/usr/bin/env python3
"""Converts published fits (JSON lines: source, material, diffuse, specular) into albedo's parameter names.

    python3 convert_ngan_fits.py fits.jsonl [--cook-torrance-scale X] [--output DIRECTORY]

Writes ngan_ward.json, ngan_cook_torrance.json and ngan_ashikhmin_shirley.json, one material a line. README.md says what
each number means; --cook-torrance-scale (default 1; 4/pi for bbm's reading) is the factor between the fits' specular scale and ours.
"""

import argparse
import json
import os

MATERIALS = 86


def ward(diffuse, specular):
    return {"alpha": specular["roughness"], "rho_s": specular["albedo"], "rho_d": diffuse}


def cook_torrance(diffuse, specular, scale):
    return {"m": specular["roughness"], "f0": specular["eta"], "masking": "v_cavity",
            "k_s": [scale * a for a in specular["albedo"]], "k_d": diffuse}


def ashikhmin_shirley(diffuse, specular):
    return {"n": specular["sharpness"], "r_s": specular["fresnelReflectance"],
            "k_s": specular["albedo"], "k_d": diffuse}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("fits")
    parser.add_argument("--cook-torrance-scale", type=float, default=1.0)
    parser.add_argument("--output", default=os.path.dirname(os.path.abspath(__file__)))
    arguments = parser.parse_args()
    scale = arguments.cook_torrance_scale
    targets = {
        "ngan_ward": ("ward", ward),
        "ngan_cooktorrance": ("cook_torrance", lambda d, s: cook_torrance(d, s, scale)),
        "ngan_ashikhminshirley": ("ashikhmin_shirley", ashikhmin_shirley),
    }
    rows = {source: [] for source in targets}
    with open(arguments.fits) as fits:
        for line in fits:
            fit = json.loads(line)
            if fit["source"] in targets:
                model, convert = targets[fit["source"]]
                rows[fit["source"]].append(
                    {"name": fit["material"], "model": model, "parameters": convert(fit["diffuse"], fit["specular"])})
    for source, (model, _) in targets.items():
        if len(rows[source]) != MATERIALS or len({r["name"] for r in rows[source]}) != MATERIALS:
            raise SystemExit("%s: expected %d materials with distinct names" % (source, MATERIALS))
        with open(os.path.join(arguments.output, "ngan_%s.json" % model), "w") as out:
            out.write("[\n" + ",\n".join(json.dumps(r) for r in rows[source]) + "\n]\n")


if __name__ == "__main__":
    main()
