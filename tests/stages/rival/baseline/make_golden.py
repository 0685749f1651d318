#!/usr/bin/env python3
"""Prints the tables of golden_test.cpp: kernels and height maps of the depth-based simulator by SciPy and NumPy
(made with SciPy 1.10.1), independently of our C++.

gaussian_filter makes the kernels; convolution is scipy.ndimage.correlate with mode "mirror" (mirrored about pixel
centres) and the origin of an even kernel shifted to index n // 2."""
import numpy as np
from scipy.ndimage import correlate, gaussian_filter


def kernel(size, sigma):
    impulse = np.zeros((size, size))
    impulse[size // 2, size // 2] = 1
    return gaussian_filter(impulse, sigma, mode="reflect", truncate=4)


def object_height(width, height):
    """A ball's cap and a slanted block, in metres, by formula; golden_test.cpp has the same."""
    y, x = np.meshgrid(np.arange(height), np.arange(width), indexing="ij")
    ball = 8e-4 - 4e-6 * ((x - 33) ** 2 + (y - 27) ** 2)
    block = np.where((abs(x - 70) < 9) & (abs(y - 40) < 12), 3e-4 + 1e-5 * (x - 70), 0)
    return np.maximum(np.maximum(ball, block), 0)


def smear(f, k, h):
    out = correlate(f, k, mode="mirror")
    top = out.max()
    return np.maximum(out * (h.max() / top if top else 1), h)


def difference(h, near, far, rounds):
    a = b = h
    for _ in range(rounds):
        a = smear(a, near, h)
    for _ in range(rounds):
        b = smear(b, far, h)
    for _ in range(rounds):
        b = smear(b, near, h)
    return 2 * a - b


def exponential():
    j, i = np.meshgrid(np.arange(-6, 7), np.arange(-6, 7))
    w = 201 / (200 + np.exp(np.sqrt(i**2 + j**2)))
    return w / w.sum()


def raised(h, k, rounds):
    f = h
    for _ in range(rounds):
        f = np.maximum(correlate(f, k, mode="mirror"), h)
    return f


def two_gaussians(h, near, near_rounds, far, far_rounds):
    return correlate(2 * raised(h, near, near_rounds) - raised(h, far, far_rounds), near, mode="mirror")


SMALL = {3: (1, 2, 1), 5: (1, 4, 6, 4, 1), 7: (2, 7, 14, 18, 14, 7, 2)}


def window(size, factor):
    """OpenCV's Gaussian of `size` pixels, for small sizes a table, on pixels 1/factor times as large, cut at half its width."""
    sigma, half = (0.3 * ((size - 1) / 2 - 1) + 0.8) * factor, int(np.floor((size - 1) / 2 * factor + 0.5))
    if size in SMALL:
        table = np.array(SMALL[size]) / sum(SMALL[size])
        if factor == 1:
            return np.outer(table, table)
        sigma = factor * np.sqrt((table * (np.arange(size) - size // 2) ** 2).sum())
    w = np.exp(-0.5 * (np.arange(-half, half + 1) / sigma) ** 2)
    return np.outer(w, w) / w.sum() ** 2


def pyramid(h, sizes, share, factor):
    f = h
    for size in sizes[:-1]:
        f = correlate(f, window(size, factor), mode="mirror")
        f = np.where(h > share * h.max(), h, f)
    return correlate(f, window(sizes[-1], factor), mode="mirror")


for size, sigma in ((21, 7), (52, 9), (3, 1), (5, 4)):
    profile = kernel(size, sigma).sum(axis=0)
    print(f"{{{size}, {sigma}, {{" + ", ".join(repr(float(v)) for v in profile) + "}},")
h = object_height(100, 80)
points = ((33, 27), (5, 5), (50, 30), (70, 40), (80, 52), (99, 79), (0, 40), (62, 28))
near, far = kernel(21, 7), kernel(52, 9)
maps = {
    "correlate": correlate(h, far, mode="mirror"),
    "difference": difference(h, near, far, 3),
    "two_gaussians": two_gaussians(h, kernel(5, 3), 6, kernel(7, 7), 3),
    "pyramid of Taxim at 0.05926 mm": pyramid(h, (201, 101, 51, 21, 11, 5, 5), 0.4, 0.0295 / 0.05926),
    "pyramid of FOTS at 0.05926 mm": pyramid(h, (51, 21, 11, 5, 5), 0, 0.0510725 / 0.05926),
    "pyramid of FOTS at its own pixels": pyramid(h, (51, 21, 11, 5, 5), 0, 1),
    "exponential": correlate(0.03 - h, exponential(), mode="constant", cval=0.03),
}
for name, m in maps.items():
    print(name, ", ".join(f"{{{x}, {y}, {float(m[y, x])!r}}}" for x, y in points))
print("weights", repr(float(exponential()[6, 6])), repr(float(exponential()[0, 0])), repr(float(exponential()[6, 0])))
