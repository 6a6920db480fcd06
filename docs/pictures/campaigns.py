"""Tables and pictures of docs/evidence.md from campaigns: `pip install pyarrow matplotlib`, then

    python docs/pictures/campaigns.py out      # out/example1-paper, out/example1-ours, out/example2-paper, ...

Nothing is told by colour alone.
"""
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np
import pyarrow.parquet as parquet

PICTURES = Path(__file__).resolve().parent
EXAMPLES = [1, 2, 3]
RULES = {"paper": "paper, freeze, chiaverini", "ours": "cone, land, siciliano-slotine"}
PROMISED = ["inside_stays", "outside_never_worse", "entered_stays"]
LEFT, FURTHER = ["inside_stays", "entered_stays"], ["outside_never_worse"]
PROPERTIES = ["equality_converges", *PROMISED, "low_priority_excess"]
INK, GREY = "#222222", "#777777"
ORANGE, BLUE = "#d55e00", "#0072b2"
#: Class, colour, hatch.
CLASSES = [
    ("none", "#009e73", ""),
    ("on-its-way", "#9ad7c3", "//"),
    ("local-minimum", "#56b4e9", ".."),
    ("singularity", "#0072b2", ""),
    ("dependent-tasks", "#cc79a7", "xx"),
    ("conflict-of-sets", "#f0e442", "\\\\"),
    ("frozen-inside", "#e69f00", "--"),
    ("speed-limit", "#b2df8a", "oo"),
    ("freeze", "#d55e00", ""),
    ("announced", "#bbbbbb", ""),
    ("fault", "#000000", ""),
    ("unexplained", "#444444", "++"),
]

plt.rcParams.update(
    {
        "axes.edgecolor": GREY,
        "axes.labelcolor": INK,
        "axes.spines.right": False,
        "axes.spines.top": False,
        "axes.titlesize": 11,
        "figure.facecolor": "white",
        "font.size": 10,
        "hatch.linewidth": 0.5,
        "savefig.facecolor": "white",
        "svg.hashsalt": "conik",
        "xtick.color": GREY,
        "ytick.color": GREY,
    }
)


def main():
    out = Path(sys.argv[1])
    tables = {(e, r): parquet.read_table(out / f"example{e}-{r}" / "runs.parquet") for e in EXAMPLES for r in RULES}
    kept(tables)
    became(tables)
    curves(tables)
    bars(tables)


def column(table, name):
    return table.column(name).to_numpy(zero_copy_only=False)


def wilson(broken, shown):
    """The share that is not exceeded with 95 % confidence, as the campaign itself has it."""
    if shown == 0:
        return float("nan")
    z, p = 1.6448536, broken / shown
    middle = p + z * z / (2 * shown)
    return (middle + z * math.sqrt(p * (1 - p) / shown + z * z / (4 * shown * shown))) / (1 + z * z / shown)


def percent(share):
    return "–" if math.isnan(share) else f"{100 * share:.3g} %"


def kept(tables):
    print("| example | settings | runs | property 1 | property 2 | property 3 | property 4 | left by at most (2, 4) | further out by at most (3) |")
    print("|---|---|---:|---:|---:|---:|---:|---:|---:|")
    for (example, rule), table in tables.items():
        cells = []
        for name in PROPERTIES[:4]:
            values = [value for value in table.column(name).to_pylist() if value is not None]
            broken = values.count(False)
            cells.append(f"{len(values) - broken:,} of {len(values):,} (< {percent(wilson(broken, len(values)))})")
        left, further = (max(np.nanmax(column(table, f"{name}_worst")) for name in names) for names in [LEFT, FURTHER])
        print(f"| {example} | `{RULES[rule].replace(', ', '/')}` | {table.num_rows:,} | {' | '.join(cells)} | {left:.2g} | {further:.2g} |")
    print()


def became(tables):
    names = [name for name, _, _ in CLASSES]
    counts = {key: {name: table.column("class").to_pylist().count(name) for name in names} for key, table in tables.items()}
    names = [name for name in names if any(of[name] for of in counts.values())]
    print("| example | settings |", " | ".join(f"`{name}`" for name in names), "| all waypoints | last one after [s], median | mode changes, median / most |")
    print("|---|---|" + "---:|" * (len(names) + 3))
    for (example, rule), table in tables.items():
        reached = column(table, "waypoints_reached")
        arrived = column(table, "arrived_s").astype(float)
        changes = column(table, "mode_changes")
        cells = [f"{counts[example, rule][name]:,}" for name in names]
        last = [
            f"{int((reached == 2).sum()):,}",
            f"{np.nanmedian(arrived):.1f}" if np.isfinite(arrived).any() else "–",
            f"{np.median(changes):.0f} / {changes.max():,}",
        ]
        print(f"| {example} | `{RULES[rule].replace(', ', '/')}` | {' | '.join(cells + last)} |")
    print()


def curves(tables):
    """How many runs left a set by more than so much."""
    figure, panels = plt.subplots(1, 3, figsize=(9.6, 3.1), sharey=True, layout="constrained")
    least = 1e-7
    for panel, example in zip(panels, EXAMPLES):
        for rule, colour, dashes in [("paper", ORANGE, "-"), ("ours", BLUE, "--")]:
            table = tables[example, rule]
            worst = np.nanmax([column(table, f"{name}_worst").astype(float) for name in PROMISED], axis=0)
            at = np.logspace(math.log10(least), 0.3, 300)
            share = 1 - np.searchsorted(np.sort(worst), at, side="right") / len(worst)
            panel.plot(at, 100 * share, dashes, color=colour, label=RULES[rule], linewidth=2)
        panel.axvline(1e-6, color=GREY, linewidth=0.8, linestyle=":")
        panel.set(xscale="log", xlim=(least, 2), ylim=(-3, 103), title=f"Example {example}", xlabel="left by more than [m, or – for the view]")
    panels[0].set_ylabel("runs [%]")
    panels[1].annotate("right of this: broken", (1.3e-6, 12), color=GREY, fontsize=9)
    panels[2].legend(frameon=False, fontsize=9, loc="upper right")
    save(figure, "campaigns-left.svg")


def bars(tables):
    """What became of the runs."""
    figure, axes = plt.subplots(figsize=(9.6, 3.4), layout="constrained")
    seen = {}
    for row, (example, rule) in enumerate(tables):
        classes = tables[example, rule].column("class").to_pylist()
        left = 0.0
        for name, colour, hatch in CLASSES:
            share = 100 * classes.count(name) / len(classes)
            if share == 0:
                continue
            bar = axes.barh(row, share, left=left, color=colour, hatch=hatch, edgecolor="white", height=0.72)
            seen.setdefault(name, bar)
            if share > 5:
                axes.text(left + share / 2, row, f"{share:.0f} %", ha="center", va="center", fontsize=9, color="black", bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.2, "alpha": 0.8})
            left += share
    axes.set_yticks(range(len(tables)), [f"Example {e}: {RULES[r]}" for e, r in tables], color=INK)
    axes.invert_yaxis()
    axes.set(xlim=(0, 100), xlabel="runs [%]")
    names = ["none: everything kept" if name == "none" else name for name in seen]
    figure.legend(seen.values(), names, loc="outside lower center", ncols=6, frameon=False, fontsize=9)
    save(figure, "campaigns-became.svg")


def save(figure, name):
    figure.savefig(PICTURES / name, metadata={"Date": None})
    print(PICTURES / name)


if __name__ == "__main__":
    main()
