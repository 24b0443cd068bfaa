#!/usr/bin/env python3
"""The errors of a rig over the number of scenes, for each noise, and by what joins the scenes.

number_of_scenes.py CROON OUT [OPTIONS OF CROON RUN]: runs number_of_scenes.json (standing, noise none and real_still)
and number_of_scenes_driving.json (noise real) beside this file with each number of scenes, in a folder of OUT for each;
prints three Markdown tables, and writes OUT/number_of_scenes.svg. What is in OUT already is not run again. A cell has
the median and the 95th percentile of the accepted poses of all sensors. The tables:
  1. bundle_adjustment over the number, for each noise, with how many poses are accepted and right, and accepted and
     wrong; below, the exponent of n in the median, by least squares.
  2. with real_still, each way to join the scenes.
  3. joint against pairs (comparison_by_dof.csv), for each noise: by how many times the median error of each other way
     is that of bundle_adjustment, the least and the most of the 24 degrees of freedom of all sensors; in how many of
     the 24 the median of the paired differences is above zero, so the other way is worse, and in how many below; and
     the least p of the latter, over groups of scenes and without correction.
"""
import math
import os
import statistics

from runs import accepted, head, percentile_95, row, rows_of, run_changed, start

NUMBERS = (1, 2, 5, 10, 20, 50)
TOTALS = {1: 20, 2: 40, 5: 40, 10: 40, 20: 80, 50: 100}  # Scenes of all groups of one number.
NOISES = {"none": ("number_of_scenes", "#777777"), "real_still": ("number_of_scenes", "#1b6ca8"),
          "real": ("number_of_scenes_driving", "#c4722c")}
BASE = "base"


def errors(trials):
    """(degrees, mm) of trials."""
    return ([float(one["rotation_error_deg"]) for one in trials],
            [1000 * float(one["translation_error_m"]) for one in trials])


def cells(trials):
    """Median and 95th percentile of the rotation in degrees, and of the translation in mm."""
    if len(trials) < 2:
        return ["-", "-"]
    rotation, translation = errors(trials)
    return [f"{statistics.median(rotation):.4f}, {percentile_95(rotation):.4f}",
            f"{statistics.median(translation):.1f}, {percentile_95(translation):.1f}"]


def exponent(numbers, values):
    """b of value = a n^b by least squares of the logarithms."""
    x, y = [math.log(n) for n in numbers], [math.log(value) for value in values]
    return statistics.covariance(x, y) / statistics.variance(x)


def over_noises(found):
    """Table 1."""
    head("noise", "scenes", "poses", "right, wrong", "rotation °", "translation mm")
    for noise in NOISES:
        for number in NUMBERS:
            trials = [one for one in found[noise, number] if one["variant"] == BASE]
            poses = accepted(trials)
            right = sum(one["status"] == "success" for one in poses)
            row(f"`{noise}`", number, len(trials), f"{right}, {len(poses) - right}", *cells(poses))
    for noise in NOISES:
        of = medians(found, noise)
        row(f"`{noise}`", "exponent", "", "", *(f"{exponent(NUMBERS, of[i]):.2f}" for i in (0, 1)))


def medians(found, noise):
    """Those of (degrees, mm) over NUMBERS."""
    by_number = [errors(accepted([one for one in found[noise, number] if one["variant"] == BASE]))
                 for number in NUMBERS]
    return [[statistics.median(of[i]) for of in by_number] for i in (0, 1)]


def over_ways(found):
    """Table 2."""
    trials = found["real_still", NUMBERS[0]]
    ways = list(dict.fromkeys(one["variant"] for one in trials))
    head("scenes", *(f"{way}: {what}" for way in ways for what in ("°", "mm")))
    for number in NUMBERS:
        of = found["real_still", number]
        row(number, *(cell for way in ways for cell in cells(accepted([one for one in of if one["variant"] == way]))))


def paired(results, noises):
    """Table 3."""
    head("noise", "scenes", "pairs by", "times the error", "worse", "better", "least p of the better")
    for noise in noises:
        for number in NUMBERS:
            rows = [one for one in rows_of(results[noise, number], "comparison_by_dof.csv")
                    if one["sensor"] != "all" and one["paired_difference"]]
            for way in dict.fromkeys(one["variant"] for one in rows):
                of = [one for one in rows if one["variant"] == way]
                ratios = [float(one["variant_median"]) / float(one["base_median"]) for one in of]
                better = [one for one in of if float(one["paired_difference"]) < 0]
                worse = sum(float(one["paired_difference"]) > 0 for one in of)
                least = min((float(one["wilcoxon_p_by_scene"]) for one in better), default=math.nan)
                row(f"`{noise}`", number, way, f"{min(ratios):.1f} to {max(ratios):.0f}", worse, len(better),
                    f"{least:.2f}" if better else "-")


def panel(left, title, series):
    """One panel: medians over the number of scenes, both logarithmic. `series`: (label, colour, values)."""
    width, height, top = 380, 300, 40
    values = [value for _, _, of in series for value in of]
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))

    def at(number, value):
        return (left + width * math.log(number) / math.log(NUMBERS[-1]),
                top + height * (high - math.log10(value)) / (high - low))

    parts = [f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#999"/>',
             f'<text x="{left + width / 2}" y="{top - 10}" text-anchor="middle">{title}</text>']
    for number in NUMBERS:
        x, _ = at(number, 10 ** low)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{top + height}" stroke="#eee"/>'
                     f'<text x="{x:.1f}" y="{top + height + 16}" text-anchor="middle">{number}</text>')
    for power in range(low, high + 1):
        _, y = at(1, 10 ** power)
        parts.append(f'<line x1="{left}" x2="{left + width}" y1="{y:.1f}" y2="{y:.1f}" stroke="#eee"/>'
                     f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end">{10.0 ** power:g}</text>')
    for i, (label, colour, of) in enumerate(series):
        points = [at(number, value) for number, value in zip(NUMBERS, of)]
        line = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dash = ("", "6 3", "2 3")[i % 3]
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dash}"/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{colour}"/>' for x, y in points]
        x, y = left + 14, top + height - 18 * (len(series) - i) + 6
        parts.append(f'<line x1="{x}" x2="{x + 30}" y1="{y}" y2="{y}" stroke="{colour}" stroke-width="2" '
                     f'stroke-dasharray="{dash}"/><text x="{x + 36}" y="{y + 4}">{label}</text>')
    return "\n".join(parts)


def figure(found):
    """The figure: rotation, and translation."""
    series = [[(noise, colour, medians(found, noise)[i]) for noise, (_, colour) in NOISES.items()] for i in (0, 1)]
    return ('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 940 395" font-family="sans-serif" font-size="13">\n'
            '<rect width="100%" height="100%" fill="#fff"/>\n'
            + panel(70, "median rotation error, °", series[0]) + "\n" + panel(530, "median translation error, mm", series[1])
            + '\n<text x="490" y="385" text-anchor="middle">number of scenes</text>\n</svg>\n')


def main(croon, out, *options):
    """Runs what is missing, prints the tables and writes the figure."""
    results = {}
    for number in NUMBERS:
        for noise, (name, _) in NOISES.items():
            results[noise, number] = run_changed(croon, out, options, name, {"scenes_per_trial": number},
                                                 {"scenes": TOTALS[number], "noise": noise})
    found = {key: rows_of(folder, "trials.csv") for key, folder in results.items()}
    over_noises(found)
    print()
    over_ways(found)
    print()
    paired(results, NOISES)
    with open(os.path.join(out, "number_of_scenes.svg"), "w", encoding="utf-8") as file:
        file.write(figure(found))


if __name__ == "__main__":
    start(main, __doc__)
