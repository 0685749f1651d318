#!/usr/bin/env python3
"""Prints the table kGolden of ssim_golden_test.cpp with scikit-image's numbers (made with version 0.19.3).

The images are formulas in whole numbers; test_images.h has the same ones."""
import numpy as np
from skimage.metrics import mean_squared_error, peak_signal_noise_ratio, structural_similarity


def pattern(width, height):
    y, x, c = np.meshgrid(np.arange(height), np.arange(width), np.arange(3), indexing="ij")
    return ((3 * x + 5 * y + 40 * c + x * y // 7 + (x * x + 3 * y) % 11) % 256).astype(np.uint8)


def change(image, kind):
    y, x, c = np.meshgrid(*(np.arange(n) for n in image.shape), indexing="ij")
    value = image.astype(int)
    if kind == "noise":
        value = value + (7 * x + 11 * y + 5 * c + x * y) % 23 - 11
    elif kind == "fade":
        value = (value * 3 + 128) // 4
    elif kind == "shift":
        value = np.roll(value, 2, axis=1)
    elif kind == "negative":
        value = 255 - value
    return np.clip(value, 0, 255).astype(np.uint8)


for width, height in ((64, 48), (31, 23), (11, 11)):
    for kind in ("noise", "fade", "shift", "negative"):
        a = pattern(width, height)
        b = change(a, kind)
        mae = np.abs(a.astype(float) - b).mean() / 255
        mse = mean_squared_error(a, b) / 255**2
        wang = structural_similarity(
            a, b, channel_axis=2, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=255)
        box = structural_similarity(a, b, channel_axis=2, data_range=255)
        print(f'{{{width}, {height}, "{kind}", {mae!r}, {mse!r}, {peak_signal_noise_ratio(a, b)!r}, {wang!r}, {box!r}}},')
