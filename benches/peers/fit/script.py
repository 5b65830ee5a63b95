"""What an engineer writes without Trunnion: both runs from CSV with pandas, the two steps with NumPy, covariance and curve with its
95 % band. Nothing else of what `trunnion fit` says. Usage: script.py TILTING.csv SEPARATION.csv"""

import sys

import numpy as np
import pandas as pd

R, PI = 150.0, np.pi


def f1(x):
    return x * (x - 2 * PI) * (x * x - 2 * PI**2)


def f2(x):
    return x * (x - PI) * (x - 2 * PI)


def fit(rows, y):
    coefficients, *_ = np.linalg.lstsq(rows, y, rcond=None)
    r = np.linalg.qr(rows, mode="r")
    inverse = np.linalg.inv(r)
    unit = inverse @ inverse.T
    residual = y - rows @ coefficients
    return coefficients, unit * (residual @ residual) / (len(y) - rows.shape[1]), unit


one, two = (pd.read_csv(file) for file in sys.argv[1:3])
a, y = np.radians(two["a_deg"].to_numpy()), two["dr_um"].to_numpy() * 1e-3
s, c = np.sin(a), np.cos(a)
second = np.column_stack([R**2 * s**2 * c, R**3 * s * c**3, R**2 * s * c**2, R * s * c, R * c**2, c, s, np.full(len(a), R)])
k, cov_k, _ = fit(second, y)
a, y = np.radians(one["a_deg"].to_numpy()), one["dr_um"].to_numpy() * 1e-3
s, c = np.sin(a), np.cos(a)
shared = np.column_stack([R**2 * s**3, R**3 * s**2 * c**2, R**2 * s**2 * c, R * s**2, R * s * c])
own = np.column_stack([R * f1(a), R * f2(a), s, c, np.ones(len(a))])
e, cov_e, unit = fit(own, y - shared @ k[:5])
gain = -unit @ (own.T @ shared)
cov = cov_e + gain @ cov_k[:5, :5] @ gain.T
for name, value, std in zip(("e_xa1", "e_xa2", "k6", "k7", "k8"), e, np.sqrt(np.diag(cov))):
    print(f"{name} {value:.6e} +- {1.96 * std:.1e}")
for degrees in range(0, 360, 5):
    g = np.array([f1(np.radians(degrees)), f2(np.radians(degrees)), 0, 0, 0])
    print(f"{degrees:4d} {g @ e * 1e6:10.3f} +- {1.96 * np.sqrt(g @ cov @ g) * 1e6:.3f} urad")
