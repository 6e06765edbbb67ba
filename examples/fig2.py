"""Fig. 2 of Habib & Sakai, first case, with matplotlib: end curvatures that a cubic spiral joins at angles 0.7 and 1.4.

    python examples/fig2.py fig2.png
"""

import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import spiral_atlas

# %% The region: the shipped recipe has all three cases, and its first atlas is the first case.
atlas = spiral_atlas.generate("atlases/habib-sakai-fig2.toml")[0]
region = atlas.to_xarray().squeeze()
names = region.flags.attrs["flag_meanings"].split()
fig, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
for name, color in [("SOLVABLE", "#d9d9d9"), ("SPIRAL", "#7fb2d9"), ("THEOREM31", "#1f5f99")]:
    holds = (region.flags.values >> names.index(name) & 1).T
    left.contourf(region.kappa0, region.kappa1, holds, levels=[0.5, 1.5], colors=[color])
    left.plot([], [], "s", color=color, label=name)
left.plot(0.4, 4, "k+", label="example 1")
left.set(yscale="log", xlabel="κ₀", ylabel="κ₁", title="φ₀ = 0.7, φ₁ = 1.4")
left.legend(loc="lower right")

# %% The curve of example 1. The ends of the normalised frame are (-1, 0) and (1, 0).
fit = spiral_atlas.fit((-1, 0), (1, 0), -0.7, 1.4, 0.4, 4)
fit.curve.plot(right, color="black")
right.plot(*fit.curve.control_points.T, "o--", color="#999999")
right.set(title=f"length {fit.curve.length:.6f}")
fig.savefig(sys.argv[1] if len(sys.argv) > 1 else "fig2.png", dpi=100)
