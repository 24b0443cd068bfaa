#!/usr/bin/env python3
"""Writes a small report.html with the markup of the C++ writer, for check_report.py.

  fixture.py THREE_MIN_JS REPORT.html

The clouds are a synthetic street seen by four LiDARs, one of them rejected; names are hostile.
"""

import base64
import hashlib
import html
import json
import math
import pathlib
import random
import struct
import sys
import zlib

ASSETS = pathlib.Path(__file__).resolve().parents[2] / "framework/document/assets"
HOSTILE = '"><script>alert(1)</script>'
STATES = ["initial guess", "ground_alignment", "yaw_search", "global_alignment", "icp", "result"]
DISTANCE_UNIT_M = 0.002

# Name, role, colour, position in the level frame, yaw in degrees.
SENSORS = [
    ("top", "reference", "#999999", (0.0, 0.0, 0.0), 0.0),
    ("front_left", "accepted", "#e69f00", (1.8, 0.8, -0.9), 35.0),
    (HOSTILE, "accepted", "#56b4e9", (1.8, -0.8, -0.9), -35.0),
    ("rear", "rejected", "#009e73", (-2.0, 0.0, -0.8), 180.0),
]
GROUND_Z = -1.9

# Vertical surfaces: (x1, y1, x2, y2, height) and cylinders (x, y, radius, height).
WALLS = [(-40, 9, 24, 9, 8), (24, 9, 24, 14, 8), (24, 14, 60, 14, 6), (-40, -11, 60, -11, 7),
         (48, -30, 48, 30, 9)]
for x, y in [(8, 5.2), (15, 5.2), (-9, 5.0), (-16, -6.3), (11, -6.5), (20, -6.4)]:  # parked cars
    WALLS += [(x, y, x + 4.4, y, 1.5), (x, y + 1.8, x + 4.4, y + 1.8, 1.5),
              (x, y, x, y + 1.8, 1.5), (x + 4.4, y, x + 4.4, y + 1.8, 1.5)]
POLES = [(18, 7.4, 0.15, 6), (-6, 7.5, 0.15, 6), (6, -8.5, 0.12, 5), (30, -8.5, 0.12, 5),
         (-22, -8.5, 0.2, 7), (36, 9.0, 0.15, 6)]


def hits(x, y, angle):
    """Ranges and heights of the vertical surfaces in a direction, nearest first."""
    dx, dy = math.cos(angle), math.sin(angle)
    found = []
    for x1, y1, x2, y2, height in WALLS:
        ex, ey = x2 - x1, y2 - y1
        cross = dx * ey - dy * ex
        if abs(cross) < 1e-9:
            continue
        r = ((x1 - x) * ey - (y1 - y) * ex) / cross
        along = ((x1 - x) * dy - (y1 - y) * dx) / cross
        if r > 0.5 and 0 <= along <= 1:
            found.append((r, height))
    for cx, cy, radius, height in POLES:
        along = (cx - x) * dx + (cy - y) * dy
        across2 = (cx - x) ** 2 + (cy - y) ** 2 - along * along
        if along > 0 and across2 < radius * radius:
            found.append((along - math.sqrt(radius * radius - across2), height))
    return sorted(found)


def pose(x, y, z, yaw_deg, roll_deg=0.0):
    """A row-major 4x4 matrix, T_level_sensor."""
    c, s = math.cos(math.radians(yaw_deg)), math.sin(math.radians(yaw_deg))
    cr, sr = math.cos(math.radians(roll_deg)), math.sin(math.radians(roll_deg))
    return [c, -s * cr, s * sr, x, s, c * cr, -c * sr, y, 0, sr, cr, z, 0, 0, 0, 1]


def apply(m, p):
    return [m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3]
            for i in range(3)]


def scan(position, yaw_deg, rng):
    """Points of a 32-beam LiDAR in its own frame, with noise of 1 cm."""
    x, y, z = position
    height = z - GROUND_Z
    points = []
    for column in range(540):
        azimuth = 2 * math.pi * column / 540
        surfaces = hits(x, y, azimuth + math.radians(yaw_deg))
        for beam in range(32):
            slope = math.tan(math.radians(-24 + 34 * beam / 31))
            ground = -height / slope if slope < 0 else math.inf
            r = ground
            for surface, top in surfaces:
                if surface < r and height + surface * slope < top:
                    r = surface
                    break
            if r > 60 or r < 1.5:
                continue
            r += rng.gauss(0, 0.01)
            points.append((r * math.cos(azimuth), r * math.sin(azimuth), r * slope))
    return points


def surface_distance(p):
    """The distance of a point in the level frame to the street's nearest surface."""
    best = abs(p[2] - GROUND_Z)
    for x1, y1, x2, y2, _ in WALLS:
        ex, ey = x2 - x1, y2 - y1
        t = ((p[0] - x1) * ex + (p[1] - y1) * ey) / (ex * ex + ey * ey)
        t = min(max(t, 0.0), 1.0)
        best = min(best, math.hypot(p[0] - x1 - t * ex, p[1] - y1 - t * ey))
    for cx, cy, radius, _ in POLES:
        best = min(best, abs(math.hypot(p[0] - cx, p[1] - cy) - radius))
    return best


def base64_of(data):
    return base64.b64encode(data).decode()


def sensor_json(index, rng):
    name, role, colour, position, yaw = SENSORS[index]
    points = scan(position, yaw, rng)
    scale = 0.002
    quantised = [round(value / scale) for point in points for value in point]
    truth = pose(*position, yaw)
    poses = []
    for k in range(len(STATES)):
        error = 0.0 if role == "reference" else [1.0, 0.7, 0.2, 0.05, 0.02, 0.0][k]
        shift = 0.4 if role == "rejected" else 0.0
        poses.append(pose(position[0] + 0.5 * error + shift, position[1] - 0.4 * error, position[2],
                          yaw + 25 * error + 2 * shift, 8 * error if k == 0 else 0.0))
    if index == 2:
        poses[1] = None
    distances = {}
    for k in (0, len(STATES) - 1):
        data = bytearray()
        for point in points:
            gap = surface_distance(apply(poses[k], point)) / DISTANCE_UNIT_M
            data.append(255 if gap > 254 or abs(point[0]) > 30 else int(gap))
        distances[str(k)] = base64_of(bytes(data))
    sensor = {"name": name, "colour": colour, "role": role, "count": len(points),
              "scale_m": scale, "origin_m": [0.0, 0.0, 0.0],
              "points": base64_of(struct.pack("<%dh" % len(quantised), *quantised)),
              "poses": poses, "distances": distances}
    if role == "rejected":
        sensor["rival"] = pose(position[0] - 2.1, position[1], position[2], yaw + 181)
    top_view = [(apply(poses[-1], point), colour) for point in points]
    return sensor, top_view, truth


def png(width, height, pixel):
    """The bytes of a picture whose pixels are the three bytes `pixel(x, y)`."""
    rows = b"".join(b"\0" + b"".join(pixel(x, y) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) +
            chunk(b"IEND", b""))


def picture(marks, centre, half_width, alt, caption):
    width, height = 640, 400
    pixels = {}
    for (x, y, _), colour in marks:
        u = int((x - centre[0] + half_width) / (2 * half_width) * width)
        v = int(height / 2 - (y - centre[1]) / (2 * half_width) * width)
        if 0 <= u < width and 0 <= v < height:
            pixels[u, v] = bytes.fromhex(colour[1:])
    data = png(width, height, lambda x, y: pixels.get((x, y), b"\xff\xff\xff"))
    return (f'<figure class="picture"><figcaption>{html.escape(caption)}</figcaption>'
            f'<img alt="{html.escape(alt)}" width="{width}" height="{height}" '
            f'src="data:image/png;base64,{base64_of(data)}"></figure>')


CHART_CSS = """
.k-page { fill: #ffffff; } .k-grid { stroke: #e2e2e2; } .k-c0 { stroke: #0072b2; fill: #0072b2; }
.k-c1 { stroke: #d55e00; fill: #d55e00; } .k-curve { fill: none; stroke-width: 2; }
.k-small { font: 11px sans-serif; fill: #555555; } .k-name { font: 12px sans-serif; fill: #222222; }
@media screen and (prefers-color-scheme: dark) {
  .k-page { fill: #16181c; } .k-grid { stroke: #33373d; } .k-c0 { stroke: #4aa8e0; fill: #4aa8e0; }
  .k-curve { fill: none; } .k-small { fill: #aaaaaa; } .k-name { fill: #dddddd; }
}
"""


def chart(title, rng, width=620, height=230):
    left, top, bottom = 56, 12, height - 36
    parts = [f'<rect class="k-page" x="0" y="0" width="{width}" height="{height}"/>']
    for i in range(5):
        y = top + (bottom - top) * i / 4
        parts.append(f'<line class="k-grid" x1="{left}" x2="{width - 16}" y1="{y}" y2="{y}"/>'
                     f'<text class="k-small" x="{left - 6}" y="{y + 4}" text-anchor="end">'
                     f'{20 - 5 * i}</text>')
    for series in (0, 1):
        corners = []
        for i in range(37):
            x = left + (width - left - 16) * i / 36
            value = 0.35 + 0.15 * series + 0.1 * math.sin(i / 3 + series) + rng.gauss(0, 0.03)
            corners.append(f"{x:.1f},{bottom - value * (bottom - top):.1f}")
        parts.append(f'<polyline class="k-curve k-c{series}" points="{" ".join(corners)}"/>')
    for i in range(0, 37, 6):
        x = left + (width - left - 16) * i / 36
        parts.append(f'<text class="k-small" x="{x}" y="{bottom + 15}" text-anchor="middle">'
                     f'{10 * i - 180}</text>')
    parts.append(f'<text class="k-name" x="{(left + width) / 2}" y="{height - 4}" '
                 f'text-anchor="middle">azimuth, °</text>')
    return (f'<figure class="chart"><figcaption>{html.escape(title)}</figcaption>'
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" role="img"><desc>{html.escape(title)}</desc>'
            f'{"".join(parts)}</svg></figure>')


class Page:
    def __init__(self):
        self.scripts = []

    def copy(self, text):
        """The id of a stored text. A backslash after each "<" keeps it from ending a script."""
        name = f"copy-{len(self.scripts) + 1}"
        safe = text.replace("<", "<\\")
        self.scripts.append(f'<script type="text/plain" id="{name}">{safe}</script>')
        return name

    def copies(self, texts):
        return " ".join(f'<button data-copy="{self.copy(text)}">{label}</button>'
                        for label, text in texts)

    def card(self, name, kind, status, lines, exports):
        body = "".join(f"<p>{html.escape(line)}</p>" for line in lines)
        details = "" if not exports else (
            f'<details class="copies"><summary>Copy the pose</summary>'
            f'{self.copies(exports)}</details>')
        return (f'<article class="card {kind}"><h3>{html.escape(name)}</h3>'
                f'<p class="status">{status}</p>{body}{details}</article>')

    def table(self, caption, columns, rows):
        """`columns`: names and whether they are numbers; a number's cell: (value, text)."""
        head = "".join(f'<th{" class=" + chr(34) + "number" + chr(34) if number else ""}>'
                       f'{html.escape(name)}</th>' for name, number in columns)
        body = ""
        for row in rows:
            body += "<tr>"
            for cell, (_, number) in zip(row, columns):
                body += (f'<td class="number" data-value="{cell[0]}">{cell[1]}</td>' if number
                         else f"<td>{html.escape(cell)}</td>")
            body += "</tr>"
        flat = [[cell[1] if isinstance(cell, tuple) else cell for cell in row] for row in rows]
        names = [name for name, _ in columns]
        csv = "\n".join(",".join('"%s"' % cell.replace('"', '""') for cell in row)
                        for row in [names] + flat) + "\n"
        markdown = "\n".join("| " + " | ".join(row) + " |" for row in [names] + flat) + "\n"
        return (f'<figure class="table"><figcaption>{html.escape(caption)}</figcaption>'
                f'<div class="scroll"><table class="sortable"><thead><tr>{head}</tr></thead>'
                f'<tbody>{body}</tbody></table></div><p class="copies">Copy as '
                f'{self.copies([("CSV", csv), ("Markdown", markdown)])}</p></figure>')


def pose_exports(name, matrix):
    x, y, z = matrix[3], matrix[7], matrix[11]
    yaml = f"sensors:\n  {json.dumps(name)}:\n    x: {x:.6f}\n    y: {y:.6f}\n    z: {z:.6f}\n"
    return [("ROS 2", f"static_transform_publisher --x {x:.6f} --y {y:.6f} --z {z:.6f} "
                      f"--frame-id base_link --child-frame-id '{name}'\n"),
            ("Autoware", yaml), ("matrix", " ".join(f"{value:.9g}" for value in matrix) + "\n"),
            ("comment", f"<!--<script> {name} <\\/ </script> -->\n")]


def write(three, target):
    rng = random.Random(53)
    page = Page()
    sensors, top_view, truths = [], [], []
    for index in range(len(SENSORS)):
        sensor, marks, truth = sensor_json(index, rng)
        sensors.append(sensor)
        top_view += marks
        truths.append(truth)
    closeups = [("pole 18 m ahead", (18, 7.4, 0), 2.0), ("wall across the road", (48, 0, 0), 4.0),
                ("corner of a house", (24, 9, 0), 2.5)]
    view = {"states": STATES, "frame_note": "level frame of the reference",
            "distance_unit_m": DISTANCE_UNIT_M, "sensors": sensors,
            "closeups": [{"title": title, "centre_m": list(centre), "half_width_m": half}
                         for title, centre, half in closeups]}
    plain = [{key: value for key, value in sensor.items() if key not in ("distances", "rival")}
             for sensor in sensors[:2]]
    for sensor in plain:
        sensor["poses"] = [sensor["poses"][0], sensor["poses"][-1]]
    plain_view = {"states": ["initial guess", "result"], "frame_note": "", "distance_unit_m": 0.002,
                  "sensors": plain, "closeups": []}
    views = "".join(f'<script type="application/json" id="{name}">' +
                    json.dumps(data).replace("<", "\\u003c") + "</script>"
                    for name, data in (("view-1", view), ("view-2", plain_view)))

    cards = [page.card("top", "neutral", "reference", ["defines the frame; 11,204 points"], []),
             page.card("front_left", "accepted", "accepted", [
                 "x 1.800 ± 0.004 m, y 0.800 ± 0.003 m, z −0.900 ± 0.002 m",
                 "roll 0.01 ± 0.02°, pitch 0.00 ± 0.02°, yaw 35.00 ± 0.03°",
                 "1.2 cm and 0.08° from nominal"], pose_exports("front_left", truths[1])),
             page.card(HOSTILE, "accepted", "accepted", [
                 "x 1.800 ± 0.004 m, y −0.800 ± 0.003 m, z −0.900 ± 0.002 m",
                 "roll 0.02 ± 0.02°, pitch 0.01 ± 0.02°, yaw −35.00 ± 0.03°",
                 "0.7 cm and 0.05° from nominal"], pose_exports(HOSTILE, truths[2])),
             page.card("rear", "rejected", "rejected: ambiguous", [
                 "Two poses explain the data equally well: they differ by 2.1 m along the road.",
                 "Advice: record at a crossing or beside parked cars."],
                 pose_exports("rear", truths[3]))]
    pose_columns = [("sensor", False)] + [(name, True) for name in (
        "x, m", "y, m", "z, m", "roll, °", "pitch, °", "yaw, °", "from nominal, mm")]
    pose_rows = []
    for (name, _, _, position, yaw), nominal in zip(SENSORS[1:], (12.0, 7.0, None)):
        numbers = list(position) + [0.01, 0.02, yaw]
        pose_rows.append([name] + [(value, f"{value:.2f} ± 0.01".replace("-", "−"))
                                   for value in numbers] +
                         [("", "") if nominal is None else (nominal, f"{nominal:g}")])
    pairs = [("top", "front_left", 0.62, 11, "accepted"), ("top", HOSTILE, 0.58, 14, "accepted"),
             ("top", "rear", 0.31, 214, "rejected"), ("front_left", HOSTILE, 0.27, 9, "accepted")]
    pair_rows = [[a, b, (overlap, f"{100 * overlap:.0f} %"), (gap, str(gap)), verdict]
                 for a, b, overlap, gap, verdict in pairs]
    charts = [chart(f"Residual over azimuth, {name}", rng) for name in ("front_left", HOSTILE)]
    fallback = picture(top_view, (5, 0), 35, "The clouds from above",
                       "Result from above, 70 m wide")
    closeup_pictures = "".join(picture(top_view, centre, half, title, title + ", result")
                               for title, centre, half in closeups)
    title = f"Calibration of car {HOSTILE}"
    body = f"""<header><h1>{html.escape(title)}</h1>
<p class="lead">3 of 4 sensors are usable: 2 accepted, 1 rejected; the reference is <b>top</b>.</p>
</header><nav aria-label="Sections"><ul>
<li><a href="#verdict">Verdict</a></li><li><a href="#poses">Poses</a></li>
<li><a href="#clouds">Clouds</a></li><li><a href="#residuals">Residuals</a></li>
<li><a href="#provenance">Provenance</a></li></ul></nav>
<main>
<section id="verdict"><h2>Verdict</h2>
<p>Use the poses of front_left and {html.escape(HOSTILE)}. Do not use the pose of rear.</p>
<p class="warning">rear: rejected because a rival pose fits equally well.</p>
<div class="cards">{"".join(cards)}</div>
<ul class="points"><li>12 scenes of 12 were used.</li><li>The clocks agree to within 2 ms.</li></ul>
</section>
<section id="poses"><h2>Poses</h2>
<p>Poses are T_top_sensor with one standard deviation.</p>
{page.table("Poses and distance from nominal", pose_columns, pose_rows)}
<section id="pairs"><h3>Pairs of sensors</h3>
{page.table("Overlap and median distance of pairs", [("sensor", False), ("with", False),
            ("overlap", True), ("median distance, mm", True), ("verdict", False)], pair_rows)}
</section></section>
<section id="clouds"><h2>Clouds</h2>
<figure class="cloud-view" data-view="view-1"><figcaption>Scene 3 in the frame of top</figcaption>
<div class="fallback">{fallback}<div class="row">{closeup_pictures}</div></div></figure>
<figure class="cloud-view" data-view="view-2"><figcaption>Scene 7, without distances</figcaption>
<div class="fallback">{fallback}</div></figure></section>
<section id="residuals"><h2>Residuals</h2>
<p class="note">A peak at one azimuth suggests an obstacle on the car; a wave, a tilted axis.</p>
<div class="row">{charts[0]}{charts[1]}</div>
{chart("Residual over range, all sensors", rng, 1000, 260)}</section>
<section id="provenance"><h2>Provenance</h2>
<dl class="facts"><dt>version</dt><dd>croon 0.9.0 (f8817fb)</dd><dt>recording</dt>
<dd>/data/{html.escape(HOSTILE)}/drive_0001.mcap</dd><dt>digest</dt>
<dd>sha256 {hashlib.sha256(b"x").hexdigest()}</dd></dl>
<pre>croon calibrate car.json --data /data --out results</pre></section>
</main><footer>Written by croon. This file needs no network.</footer>
"""
    scripts = [pathlib.Path(three).read_text(), (ASSETS / "cloud_view.js").read_text(),
               (ASSETS / "report.js").read_text()]
    hashes = " ".join(f"'sha256-{base64_of(hashlib.sha256(text.encode()).digest())}'"
                      for text in scripts)
    style = (ASSETS / "report.css").read_text() + CHART_CSS
    data = "".join(page.scripts) + views
    target.write_text(f"""<!doctype html><html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:;
style-src 'unsafe-inline'; script-src {hashes}">
<title>{html.escape(title)}</title><style>{style}</style></head><body>
{body}{data}{"".join(f"<script>{text}</script>" for text in scripts)}</body></html>
""")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    write(sys.argv[1], pathlib.Path(sys.argv[2]))
