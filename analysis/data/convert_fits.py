#!/usr/bin/env python3
"""Converts published fits (JSON lines: source, material, diffuse, specular) into albedo's parameter names.

    python3 convert_fits.py fits.jsonl [--cook-torrance-scale X] [--wavelength UM] [--output DIRECTORY]

Writes one file per source, one material a line. README.md says what each number means, and why. --cook-torrance-scale
(default 1; 4/pi for bbm's reading) is the factor between the specular scale of Ngan's Cook-Torrance fits and ours;
--wavelength (default 0.7) is that of the He-Torrance fits, which don't tell it.
"""

import argparse
import json
import os


def ward(diffuse, s, options):
    return {"alpha": s["roughness"], "rho_s": s["albedo"], "rho_d": diffuse}


def ngan_cook_torrance(diffuse, s, options):
    return {"m": s["roughness"], "f0": s["eta"], "masking": "v_cavity",
            "k_s": [options.cook_torrance_scale * a for a in s["albedo"]], "k_d": diffuse}


def low_cook_torrance(diffuse, s, options):
    return {"m": s["roughness"], "fresnel": "conductor", "eta": s["eta"], "k": 0, "masking": "v_cavity",
            "k_s": [scaled(4, a) for a in s["albedo"]], "k_d": diffuse}


def ngan_ashikhmin_shirley(diffuse, s, options):
    return {"n": s["sharpness"], "r_s": s["fresnelReflectance"], "k_s": s["albedo"], "k_d": diffuse}


def low_ashikhmin_shirley(diffuse, s, options):
    index = s["fresnelReflectance"]
    return {"n": s["sharpness"], "r_s": ((index - 1) / (index + 1)) ** 2, "k_s": s["albedo"], "k_d": diffuse}


def lafortune(diffuse, s, options):
    return {"c_x": s["Cxy"], "c_y": s["Cxy"], "c_z": s["Cz"], "n": s["sharpness"], "rho": s["albedo"]}


def blinn(diffuse, s, options):
    return {"n": s["sharpness"]}


def blinn_scale(s):
    n = s["sharpness"]
    return [4 * (2 ** (-n / 2) + n) / (n + 4) * a for a in s["albedo"]]


def he_torrance(diffuse, s, options):
    if s["eta"] <= 1:
        return None  # rounded to three digits there is no reflection left
    return {"sigma0": s["roughness"], "tau": s["autocorrelation"], "wavelength": options.wavelength,
            "part": "directional_diffuse", "fresnel": "conductor", "eta": s["eta"], "k": 0, "k_s": s["albedo"]}


def scaled(factor, number):
    """The product without the digits that binary arithmetic adds."""
    return float("%.12g" % (factor * number))


# source: file, model, parameters, how many, whether the Lambertian part stands outside of the parameters
SOURCES = {
    "ngan_ward": ("ngan_ward", "ward", ward, 86, False),
    "ngan_wardduer": ("ngan_ward_duer", "ward_duer", ward, 86, False),
    "ngan_cooktorrance": ("ngan_cook_torrance", "cook_torrance", ngan_cook_torrance, 86, False),
    "ngan_ashikhminshirley": ("ngan_ashikhmin_shirley", "ashikhmin_shirley", ngan_ashikhmin_shirley, 86, False),
    "ngan_lafortune": ("ngan_lafortune", "lafortune", lafortune, 86, True),
    "ngan_blinnphong": ("ngan_blinn", "blinn", blinn, 86, True),
    "ngan_he": ("ngan_he_torrance", "he_torrance", he_torrance, 82, True),
    "low_cooktorrance_E1": ("low_cook_torrance_e1", "cook_torrance", low_cook_torrance, 100, False),
    "low_cooktorrance_E2": ("low_cook_torrance_e2", "cook_torrance", low_cook_torrance, 100, False),
    "low_ashikhminshirley_E1": ("low_ashikhmin_shirley_e1", "ashikhmin_shirley", low_ashikhmin_shirley, 100, False),
    "low_ashikhminshirley_E2": ("low_ashikhmin_shirley_e2", "ashikhmin_shirley", low_ashikhmin_shirley, 100, False),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("fits")
    parser.add_argument("--cook-torrance-scale", type=float, default=1.0)
    parser.add_argument("--wavelength", type=float, default=0.7)
    parser.add_argument("--output", default=os.path.dirname(os.path.abspath(__file__)))
    options = parser.parse_args()
    rows = {source: [] for source in SOURCES}
    with open(options.fits) as fits:
        for line in fits:
            fit = json.loads(line)
            source, specular = fit["source"], fit["specular"]
            if source not in SOURCES:
                continue
            _, model, convert, _, is_lobe_only = SOURCES[source]
            parameters = convert(fit["diffuse"], specular, options)
            if parameters is None:
                continue
            row = {"name": fit["material"], "model": model, "parameters": parameters}
            if source == "ngan_blinnphong":
                row["scale"] = blinn_scale(specular)
            if is_lobe_only:
                row["lambertian"] = fit["diffuse"]
            rows[source].append(row)
    for source, (name, _, _, count, _) in SOURCES.items():
        if len(rows[source]) != count or len({r["name"] for r in rows[source]}) != count:
            raise SystemExit("%s: expected %d materials with distinct names" % (source, count))
        with open(os.path.join(options.output, name + ".json"), "w") as out:
            out.write("[\n" + ",\n".join(json.dumps(r) for r in rows[source]) + "\n]\n")


if __name__ == "__main__":
    main()
