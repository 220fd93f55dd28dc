#!/usr/bin/env python3
"""Derives measured.json from RGL .bsdf files: derive_measured.py FILE...

Written from the format's description (Dupuy & Jakob 2018) with numpy; it shares nothing with the library. The albedo is the sum of
f cos(theta_o) over a tensor of midpoints of the half vector's parametrisation, u = sqrt(2 theta_m/pi) and the azimuth, with
d omega_o = 4 (L.m) sin(theta_m) d theta_m d phi_m, out to the horizon, which is an edge of every ray. `digits` is what sums of two sizes
agree on, less one.
"""

import json
import os
import struct
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
TYPES = {1: "u1", 2: "i1", 3: "<u2", 4: "<i2", 5: "<u4", 6: "<i4", 7: "<u8", 8: "<i8", 9: "<f2", 10: "<f4", 11: "<f8"}


def read(path):
    data = open(path, "rb").read()
    assert data[:12] == b"tensor_file\0"
    (count,) = struct.unpack_from("<I", data, 14)
    at, fields = 18, {}
    for _ in range(count):
        (length,) = struct.unpack_from("<H", data, at)
        name = data[at + 2 : at + 2 + length].decode()
        at += 2 + length
        dimensions, kind, offset = struct.unpack_from("<HBQ", data, at)
        at += 11
        shape = struct.unpack_from("<%dQ" % dimensions, data, at)
        at += 8 * dimensions
        fields[name] = np.frombuffer(data, TYPES[kind], int(np.prod(shape)), offset).reshape(shape)
    return fields


def cell(x, count):
    x = x * (count - 1)
    i = np.clip(np.floor(x).astype(int), 0, count - 2)
    return i, x - i


def bilinear(table, x, y):
    i, fx = cell(x, table.shape[1])
    j, fy = cell(y, table.shape[0])
    lower = (1 - fx) * table[j, i] + fx * table[j, i + 1]
    upper = (1 - fx) * table[j + 1, i] + fx * table[j + 1, i + 1]
    return (1 - fy) * lower + fy * upper


class Material:
    def __init__(self, path):
        fields = {name: f.astype(np.float64) for name, f in read(path).items() if f.dtype != np.uint8}
        self.thetas = fields["theta_i"]
        self.ndf, self.sigma = fields["ndf"], fields["sigma"]
        self.rgb = fields["rgb"][0]
        density = fields["vndf"][0]
        conditional = np.zeros_like(density)
        conditional[:, :, 1:] = np.cumsum((density[:, :, 1:] + density[:, :, :-1]) / 2, axis=2)
        rows = conditional[:, :, -1]
        marginal = np.zeros_like(rows)
        marginal[:, 1:] = np.cumsum((rows[:, 1:] + rows[:, :-1]) / 2, axis=1)
        total = marginal[:, -1].copy()
        self.density = density / total[:, None, None]
        self.conditional = conditional / total[:, None, None]
        self.marginal = marginal / total[:, None]

    def at(self, theta):
        k = int(np.clip(np.searchsorted(self.thetas, theta) - 1, 0, len(self.thetas) - 2))
        w = float(np.clip((theta - self.thetas[k]) / (self.thetas[k + 1] - self.thetas[k]), 0, 1))
        mixed = lambda table: (1 - w) * table[k] + w * table[k + 1]
        return mixed(self.density), mixed(self.conditional), mixed(self.marginal), mixed(self.rgb)

    def albedo(self, theta, count_u, count_v):
        density, conditional, marginal, rgb = self.at(theta)
        v = (np.arange(count_v) + 0.5) / count_v
        phi = (v - 0.5) * 2 * np.pi
        delta = np.arctan2(np.sin(theta) * np.cos(phi), np.cos(theta))
        last = np.sqrt(2 / np.pi * (np.pi / 4 + delta / 2))
        j, fy = cell(v, density.shape[0])
        sums = np.zeros(3)
        for block in range(0, count_v, 256):
            part = slice(block, block + 256)
            row, g, end = j[part, None], fy[part, None], last[part, None]
            u = (np.arange(count_u) + 0.5)[None, :] / count_u * end
            i, fx = cell(u, density.shape[1])
            left = (1 - g) * density[row, i] + g * density[row + 1, i]
            right = (1 - g) * density[row, i + 1] + g * density[row + 1, i + 1]
            before = (1 - g) * conditional[row, i] + g * conditional[row + 1, i]
            low, high = conditional[row, -1], conditional[row + 1, -1]
            s_x = (before + fx * (left + fx * (right - left) / 2)) / ((1 - g) * low + g * high)
            s_y = np.broadcast_to(marginal[row] + g * (low + g * (high - low) / 2), s_x.shape)
            t = np.pi / 2 * u * u
            cos_d = np.cos(t) * np.cos(theta) + np.sin(t) * np.sin(theta) * np.cos(phi[part, None])
            sigma = bilinear(self.sigma, np.sqrt(2 * theta / np.pi) * np.ones(1), 0.5 * np.ones(1))[0]
            common = bilinear(self.ndf, u, np.broadcast_to(v[part, None], u.shape)) / (4 * sigma)
            common = common * 4 * cos_d * np.sin(t) * np.pi * u * end * 2 * np.pi
            for channel in range(3):
                sums[channel] += np.sum(bilinear(rgb[channel], s_x, s_y) * common)
        return sums / (count_u * count_v)


def main():
    entries = []
    for path in sys.argv[1:]:
        material = Material(path)
        for theta in (0, 30, 60, 80):
            coarse, fine = (material.albedo(np.radians(theta), n, n) for n in (1400, 3100))
            for channel, a, b in zip("RGB", coarse, fine):
                digits = int(np.floor(-np.log10(max(abs(a / b - 1), 1e-15)))) - 1
                entries.append({"file": os.path.basename(path), "channel": channel, "theta_deg": theta,
                                "albedo": "%.10g" % b, "digits": digits})
                print(entries[-1], flush=True)
    with open(os.path.join(HERE, "measured.json"), "w") as out:
        out.write("[\n" + ",\n".join(json.dumps(e) for e in entries) + "\n]\n")


if __name__ == "__main__":
    main()
