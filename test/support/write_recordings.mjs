// Writes the recordings in test/framework/io/recordings with the libraries of the authors of MCAP and of Foxglove, and
// with Python's SQLite: readers are tested on files that other people's programs wrote. Needs npm and Python:
//
//   npm install --no-save @mcap/core@2 @foxglove/rosmsg@5 @foxglove/rosmsg2-serialization@3 \
//     @foxglove/wasm-zstd@1 lz4js@0.2
//   node test/support/write_recordings.mjs test/framework/io/recordings
import { execFileSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

// From the folder in which the packages were installed.
const require = createRequire(join(process.cwd(), "package.json"));
const { McapWriter } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageWriter } = require("@foxglove/rosmsg2-serialization");
const zstd = require("@foxglove/wasm-zstd");
const lz4 = require("lz4js");

const DEFINITION = `std_msgs/Header header
uint32 height
uint32 width
sensor_msgs/PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: sensor_msgs/PointField
string name
uint32 offset
uint8 datatype
uint32 count
`;
const writer = new MessageWriter(parse(DEFINITION, { ros2: true }));

// The datatypes of sensor_msgs/PointField, with what PCD calls them.
const TYPES = {
  int8: [1, "I", 1], uint8: [2, "U", 1], int16: [3, "I", 2], uint16: [4, "U", 2],
  int32: [5, "I", 4], uint32: [6, "U", 4], float32: [7, "F", 4], float64: [8, "F", 8],
};

function put(view, offset, type, value, little) {
  const setters = {
    int8: "setInt8", uint8: "setUint8", int16: "setInt16", uint16: "setUint16",
    int32: "setInt32", uint32: "setUint32", float32: "setFloat32", float64: "setFloat64",
  };
  view[setters[type]](offset, value, little);
}

// The stamp of a message in nanoseconds, and when its point i of n was fired: one revolution takes 0.1 s.
const START = 1700000000123456789n;
const firedAfter = (i, n) => BigInt(Math.round((1e8 * i) / n));

// Point i of scan `scan` of a sensor, with what drivers store beside it. Some beams return nothing.
function point(sensor, scan, i, n, stamp) {
  const angle = (2 * Math.PI * i) / n;
  const range = 5 + sensor + 0.5 * scan + (i % 7);
  const nothing = i % 13 === 5 ? NaN : i % 17 === 3 ? 0 : 1;
  const after = firedAfter(i, n);
  return {
    x: nothing * range * Math.cos(angle), y: nothing * range * Math.sin(angle),
    z: nothing * (1 + 0.1 * (i % 16)), intensity: i % 256, ring: i % 16, reflectivity: 3 * i,
    after: Number(after), absolute: stamp + after,
  };
}

// fields: [name, type, offset, value of a point, count]. `size` is [height, width]; `padding` bytes follow each row.
function cloud({ fields, step, size, frame, stamp, points, big = false, padding = 0 }) {
  const [height, width] = size;
  const row = width * step + padding;
  const data = new Uint8Array(height * row).fill(0xa5);
  const view = new DataView(data.buffer);
  points.forEach((p, i) => {
    const at = Math.floor(i / width) * row + (i % width) * step;
    for (const [, type, offset, value, count = 1] of fields) {
      for (let k = 0; k < count; ++k) {
        put(view, at + offset + k * TYPES[type][2], type, value(p) + k, !big);
      }
    }
  });
  const message = {
    header: { stamp: { sec: Number(stamp / 1000000000n), nanosec: Number(stamp % 1000000000n) }, frame_id: frame },
    height, width, is_bigendian: big, point_step: step, row_step: row, data, is_dense: false,
    fields: fields.map(([name, type, offset, , count = 1]) => ({ name, offset, datatype: TYPES[type][0], count })),
  };
  return writer.writeMessage(message);
}

// The same cloud as PCD, without padding.
function pcd(fields, points) {
  const of = (part) => fields.map(part).join(" ");
  const header = `# .PCD v0.7\nVERSION 0.7\nFIELDS ${of((f) => f[0])}\nSIZE ${of((f) => TYPES[f[1]][2])}\n` +
    `TYPE ${of((f) => TYPES[f[1]][1])}\nCOUNT ${of(() => 1)}\nWIDTH ${points.length}\nHEIGHT 1\n` +
    `VIEWPOINT 0 0 0 1 0 0 0\nPOINTS ${points.length}\nDATA binary\n`;
  const step = fields.reduce((sum, f) => sum + TYPES[f[1]][2], 0);
  const view = new DataView(new ArrayBuffer(step * points.length));
  let at = 0;
  for (const p of points) {
    for (const [, type, , value] of fields) {
      put(view, at, type, value(p), true);
      at += TYPES[type][2];
    }
  }
  return Buffer.concat([Buffer.from(header), Buffer.from(view.buffer)]);
}

const xyz = ["x", "y", "z"].map((axis, i) => [axis, "float32", 4 * i, (p) => p[axis]]);
const intensity = ["intensity", "float32", 16, (p) => p.intensity];
const OUSTER = [...xyz, intensity, ["t", "uint32", 20, (p) => p.after],
  ["reflectivity", "uint16", 24, (p) => p.reflectivity], ["ring", "uint8", 26, (p) => p.ring]];
const HESAI = [...xyz, intensity, ["timestamp", "float64", 24, (p) => Number(p.absolute) * 1e-9],
  ["ring", "uint16", 32, (p) => p.ring]];

// Two sensors, three messages each.
const N = 104;
const messages = [];
const pcds = {};
for (let scan = 0; scan < 3; ++scan) {
  for (const [sensor, topic] of ["left", "top"].entries()) {
    const stamp = START + BigInt(scan) * 100000000n + BigInt(sensor) * 4000000n;
    const points = [...Array(N).keys()].map((i) => point(sensor, scan, i, N, stamp));
    const fields = topic === "top" ? OUSTER : HESAI;
    const size = topic === "top" ? [8, N / 8] : [1, N];
    const data = cloud({ fields, step: topic === "top" ? 28 : 34, size, frame: topic + "_lidar", stamp, points });
    messages.push({ topic: `/${topic}/points`, time: stamp + 20000000n, data });
    pcds[`${topic}_${scan}.pcd`] = pcd(fields, points);
  }
}

// One message per convention.
const conventions = [];
function add(topic, fields, step, more = {}) {
  const points = [...Array(40).keys()].map((i) => point(0, 0, i, 40, START));
  const data = cloud({ fields, step, size: [1, 40], frame: "lidar", stamp: START, points, ...more });
  conventions.push({ topic, time: START, data });
}
add("/ouster", OUSTER, 28, { size: [4, 10], padding: 6 });
add("/velodyne", [...xyz, intensity, ["ring", "uint16", 20, (p) => p.ring],
  ["time", "float32", 22, (p) => p.after * 1e-9]], 26);
add("/hesai", HESAI, 34);
add("/robosense", [...xyz, ["intensity", "uint8", 12, (p) => p.intensity],
  ["ring", "uint16", 14, (p) => p.ring], ["timestamp", "float64", 16, (p) => Number(p.absolute) * 1e-9]], 24);
add("/livox", [...xyz, intensity, ["tag", "uint8", 20, () => 0], ["line", "uint8", 21, () => 1],
  ["timestamp", "float64", 22, (p) => Number(p.absolute)]], 30);
add("/nebula", [...xyz, ["intensity", "uint8", 12, (p) => p.intensity], ["return_type", "uint8", 13, () => 1],
  ["channel", "uint16", 14, (p) => p.ring], ["time_stamp", "uint32", 16, (p) => p.after]], 20);
add("/big_endian", HESAI, 34, { big: true });
add("/all_types", [["z", "float64", 0, (p) => p.z], ["y", "float64", 8, (p) => p.y], ["x", "float64", 16, (p) => p.x],
  ...Object.keys(TYPES).map((type, k) => [`a_${type}`, type, 24 + 16 * k, (p) => p.ring - (type[0] === "u" ? 0 : 8), 2])],
  24 + 16 * 8, { big: true });

class Memory {
  parts = [];
  size = 0n;
  async write(bytes) {
    this.parts.push(Buffer.from(bytes));
    this.size += BigInt(bytes.byteLength);
  }
  position() { return this.size; }
}

async function mcap(list, options = {}, schema = {}, encoding = "cdr") {
  const memory = new Memory();
  const file = new McapWriter({ writable: memory, chunkSize: 8000, ...options });
  await file.start({ profile: "ros2", library: "croon tests" });
  const schemaId = await file.registerSchema({
    name: "sensor_msgs/msg/PointCloud2", encoding: "ros2msg", data: Buffer.from(DEFINITION), ...schema });
  const ids = {};
  for (const [sequence, { topic, time, data }] of list.entries()) {
    ids[topic] ??= await file.registerChannel({ schemaId, topic, messageEncoding: encoding, metadata: new Map() });
    await file.addMessage({ channelId: ids[topic], sequence, logTime: time, publishTime: time, data });
  }
  await file.end();
  return Buffer.concat(memory.parts);
}

function database(path, list) {
  const program = `
import json, os, sqlite3, sys
path, rows = sys.argv[1], json.load(sys.stdin)
if os.path.exists(path): os.remove(path)
db = sqlite3.connect(path)
db.executescript("""PRAGMA page_size = 1024;
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
  offered_qos_profiles TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO topics VALUES (1, '/imu', 'sensor_msgs/msg/Imu', 'cdr', '');""")
topics = {}
for row in rows:
    if row["topic"] not in topics:
        topics[row["topic"]] = len(topics) + 2
        db.execute("INSERT INTO topics VALUES (?, ?, 'sensor_msgs/msg/PointCloud2', 'cdr', '')",
                   (topics[row["topic"]], row["topic"]))
    db.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)",
               (topics[row["topic"]], int(row["time"]), bytes.fromhex(row["data"])))
db.commit()`;
  const rows = list.map(({ topic, time, data }) =>
    ({ topic, time: time.toString(), data: Buffer.from(data).toString("hex") }));
  execFileSync("python3", ["-c", program, path], { input: JSON.stringify(rows) });
}

const folder = process.argv[2];
if (folder === undefined) {
  console.error("usage: write_recordings.mjs FOLDER");
  process.exit(2);
}
mkdirSync(folder, { recursive: true });
const save = (name, bytes) => writeFileSync(join(folder, name), bytes);
await zstd.isLoaded;
const by = (compression, compress) => ({
  compressChunk: (bytes) => ({ compression, compressedData: Buffer.from(compress(bytes)) }) });
for (const [name, bytes] of Object.entries(pcds)) save(name, bytes);
save("plain.mcap", await mcap(messages, { useChunks: false }));
save("chunks.mcap", await mcap(messages));
save("lz4.mcap", await mcap(messages, by("lz4", (bytes) => lz4.compress(bytes))));
save("zstd.mcap", await mcap(messages, by("zstd", (bytes) => zstd.compress(bytes, 9))));
save("conventions.mcap", await mcap(conventions, by("zstd", (bytes) => zstd.compress(bytes, 9))));
const one = [{ topic: "/points", time: START, data: new Uint8Array(40) }];
save("ros1.mcap", await mcap(one, {}, { name: "sensor_msgs/PointCloud2", encoding: "ros1msg" }, "ros1"));
save("livox.mcap", await mcap(one, {}, { name: "livox_ros_driver2/msg/CustomMsg" }));
save("json.mcap", await mcap(one, {}, {}, "json"));
database(join(folder, "plain.db3"), messages);
database(join(folder, "messages_zstd.db3"),
  messages.map((message) => ({ ...message, data: zstd.compress(message.data, 9) })));
