#!/usr/bin/env python3
"""When does volume help: what the experiments volume_study*.json find, as two tables and one figure.

volume_study.py CROON OUT [OPTIONS OF CROON RUN]: runs each volume_study*.json beside this file into a folder of OUT,
prints two Markdown tables, and writes OUT/volume_study.svg. What is in OUT already is not run again. Each number
compares trials with a search for the least volume with the same trials without it (comparison.csv, all sensors): the
median of the differences of the translation errors in mm, below zero if the search helps, and how many trials only
the search, and only the trials without it, bring within 0.5 degrees and 0.1 m. ** marks a difference that is
significant over scenes after Holm's correction.
"""
import os
import statistics

from runs import HERE, head, row, rows_of, run_experiment, start

BEFORE = (("rough steps", "_rough"), ("one iteration", "_one_iteration"), ("full registration", ""))
NOISES = (("none", ""), ("real_still", "_still"), ("twice real_still", "_twice"))
SEARCHES = {  # The start of the name in the grid; label; colour.
    "coordinate_scan(dofs=x+y ": ("scan of x, y", "#777777"),
    "coordinate_scan(dofs=roll+": ("scan of six", "#1b6ca8"),
    "golden_section": ("golden section of six", "#c4722c"),
    "bobyqa": ("BOBYQA", "#2f855a"),
}
LEAVES_M = (0.05, 0.1, 0.2)
LATTICES = (1, 8)
OPTIONS = "_options"


def results_of(croon, out, options, suffix):
    """The folder of the results of volume_study<suffix>.json."""
    results = os.path.join(out, f"volume_study{suffix}")
    experiment = os.path.join(HERE, f"volume_study{suffix}.json")
    run_experiment(croon, experiment, results, options)
    return results


def compared(results):
    """The comparisons over all sensors, by the name of the variant."""
    return {one["variant"]: one for one in rows_of(results, "comparison.csv") if one["sensor"] == "all"}


def by_choice(rows):
    """The rows of a grid by (lattices, leaf size, label of the search)."""
    chosen = {}
    for name, one in rows.items():
        _, lattices, leaf, search = name.split("/", 3)
        label = next(label for start, (label, _) in SEARCHES.items() if search.startswith(start))
        chosen[int(lattices.split("=")[1]), float(leaf.split("=")[1]), label] = one
    return chosen


def millimetres(one, what):
    """A difference of translation errors of comparison.csv in mm, not a number where it has none."""
    return 1000 * float(one[f"translation_{what}"] or "nan")


def in_words(one):
    """A cell: the median difference and its mark, and the trials that are won and lost."""
    mark = "**" if one["translation_significant"] == "1" == one["translation_by_scene"] else ""
    won = f"{one['only_variant']}, {one['only_base']}"
    success = "**" if one["success_significant"] == "1" == one["success_by_scene"] else ""
    return f"{millimetres(one, 'paired_difference_m'):+.1f}{mark}; {won}{success}".replace("*", r"\*")


def without(results):
    """A cell: the success and the median error of the trials without a search for the least volume."""
    trials = [one for one in rows_of(results, "trials.csv") if one["variant"] == "base"]
    errors = [float(one["translation_error_m"]) for one in trials if one["status"] == "success"]
    return f"{100 * len(errors) / len(trials):.1f} %, {1000 * statistics.median(errors):.1f} mm"


def print_study(studies, results):
    """The table of the study, of one leaf size in 8 lattices."""
    labels = [label for label, _ in SEARCHES.values()]
    head("noise", "after", "without", *labels)
    for noise, noise_suffix in NOISES:
        for before, before_suffix in BEFORE:
            key = before_suffix + noise_suffix
            cells = [in_words(studies[key][8, 0.1, label]) for label in labels]
            row(f"`{noise}`", before, without(results[key]), *cells)


def print_options(rows):
    """The table of the options of leaves and of smooth measures."""
    print()
    head("option", "difference; won, lost")
    for name, one in rows.items():
        row(name, in_words(one))


def panel(left, top, title, chosen):
    """One panel: the median difference over leaf sizes, with its interval; filled: 8 lattices, open: 1."""
    width, height = 250, 190
    values = [millimetres(one, f"paired_{end}_m") for one in chosen.values() for end in ("low", "high")]
    values = [value for value in values if value == value] + [-1.0, 1.0]
    low, high = min(values), max(values)
    low, high = low - 0.06 * (high - low), high + 0.06 * (high - low)

    def y(value):
        return top + height * (high - value) / (high - low)

    parts = [f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#999"/>',
             f'<text x="{left + width / 2}" y="{top - 7}" text-anchor="middle">{title}</text>',
             f'<line x1="{left}" x2="{left + width}" y1="{y(0):.1f}" y2="{y(0):.1f}" stroke="#000"/>']
    step = next(step for step in (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500) if (high - low) / step <= 7)
    for tick in range(round(low / step), round(high / step) + 1):
        if low <= tick * step <= high:
            parts.append(f'<line x1="{left - 4}" x2="{left}" y1="{y(tick * step):.1f}" '
                         f'y2="{y(tick * step):.1f}" stroke="#999"/>'
                         f'<text x="{left - 7}" y="{y(tick * step) + 4:.1f}" text-anchor="end">'
                         f'{tick * step:g}</text>')
    for i, leaf in enumerate(LEAVES_M):
        middle = left + width * (i + 0.5) / len(LEAVES_M)
        parts.append(f'<text x="{middle:.1f}" y="{top + height + 15}" text-anchor="middle">{leaf:g}</text>')
        for j, (label, colour) in enumerate(SEARCHES.values()):
            for k, lattices in enumerate(LATTICES):
                one = chosen[lattices, leaf, label]
                x = middle + 9 * (2 * j + k - len(SEARCHES) + 0.5)
                low_y, high_y = (y(millimetres(one, f"paired_{end}_m")) for end in ("low", "high"))
                fill = colour if lattices > 1 else "#fff"
                parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{low_y:.1f}" y2="{high_y:.1f}" '
                             f'stroke="{colour}" stroke-width="1.5"/><circle cx="{x:.1f}" '
                             f'cy="{y(millimetres(one, "paired_difference_m")):.1f}" r="3.2" '
                             f'fill="{fill}" stroke="{colour}" stroke-width="1.5"/>')
    return "\n".join(parts)


def figure(studies):
    """The figure: a row of panels per noise, a column per what comes before."""
    parts = []
    for line, (noise, noise_suffix) in enumerate(NOISES):
        for column, (before, before_suffix) in enumerate(BEFORE):
            parts.append(panel(70 + 320 * column, 40 + 255 * line, f"{noise}, after {before}",
                               studies[before_suffix + noise_suffix]))
    bottom = 40 + 255 * len(NOISES)
    parts.append(f'<text x="515" y="{bottom - 8}" text-anchor="middle">leaf size in m</text>')
    parts.append(f'<text transform="translate(18 {bottom / 2}) rotate(-90)" text-anchor="middle">'
                 "median difference of the translation errors to those without, mm</text>")
    for j, (label, colour) in enumerate(SEARCHES.values()):
        parts.append(f'<circle cx="{90 + 165 * j}" cy="{bottom + 18}" r="4" fill="{colour}"/>'
                     f'<text x="{100 + 165 * j}" y="{bottom + 22}">{label}</text>')
    parts.append(f'<text x="{100 + 165 * len(SEARCHES)}" y="{bottom + 22}">open: 1 lattice; filled: 8</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1020 {bottom + 40}" '
            f'font-family="sans-serif" font-size="12">\n<rect width="100%" height="100%" fill="#fff"/>\n'
            + "\n".join(parts) + "\n</svg>\n")


def main(croon, out, *options):
    """Runs what is missing, prints the tables and writes the figure."""
    suffixes = [before + noise for _, noise in NOISES for _, before in BEFORE]
    results = {suffix: results_of(croon, out, options, suffix) for suffix in suffixes}
    studies = {suffix: by_choice(compared(results[suffix])) for suffix in suffixes}
    print_study(studies, results)
    print_options(compared(results_of(croon, out, options, OPTIONS)))
    with open(os.path.join(out, "volume_study.svg"), "w", encoding="utf-8") as file:
        file.write(figure(studies))


if __name__ == "__main__":
    start(main, __doc__)
