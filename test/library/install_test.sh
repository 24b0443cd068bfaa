#!/usr/bin/env bash
# Installs a build of croon, then builds and runs what docs/library.md shows against the installed package.
# Usage: install_test.sh BUILD_FOLDER SOURCE_FOLDER [PYTHON]. With PYTHON, the Python package is tried too. Clouds are simulated; with recordings (CROON_DATA) the program
# calibrates real/0001 too.
set -euo pipefail

build=$1
source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "install_test: $*" >&2; exit 1; }

cmake --install "$build" --prefix "$folder/prefix" >"$folder/install.log"

# As the packages of a distribution are made.
DESTDIR=$folder/package cmake --install "$build" --prefix /opt/croon >>"$folder/install.log"
[[ -f $folder/package/opt/croon/include/croon/framework/base/rng.hpp ]] || fail 'DESTDIR lacks the headers'
rm -r "$folder/package"

# fenced_block LANGUAGE: the first block of the page in this language.
fenced_block() { awk -v start="\`\`\`$1" '$0 == start {on = 1; next} /^```/ {if (on) exit} on' "$source/docs/library.md"; }

mkdir "$folder/calibrate_two"
fenced_block cpp >"$folder/calibrate_two/calibrate_two.cpp"
fenced_block cmake >"$folder/calibrate_two/CMakeLists.txt"
[[ $(grep -c . "$folder/calibrate_two/calibrate_two.cpp") -le 15 ]] || fail 'the program has more than 15 lines'
build_project() {
  cmake -S "$1" -B "$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release "-DCMAKE_PREFIX_PATH=$folder/prefix" >"$1.log" &&
    cmake --build "$1/build" >>"$1.log" || { cat "$1.log" >&2; fail "$1 does not build"; }
}
build_project "$folder/calibrate_two"
calibrate=$folder/calibrate_two/build/calibrate_two
if ldd "$calibrate" | grep -E 'embree'; then fail 'the library needs Embree'; fi

croon=$folder/prefix/bin/croon
pipeline=$folder/prefix/share/croon/experiments/paper/pipeline.json
cat >"$folder/two.json" <<'END'
{"name": "two", "dataset": {"type": "simulated", "scenes": 1, "mix": {"urban": 1}},
 "starts": {"rotation_deg": 5, "trials": 1}, "pipeline": [{"step": "ground_alignment"}]}
END
# The module that it loads on demand is beside it, wherever the prefix is.
mv "$folder/prefix" "$folder/moved"
sed 's/"ground_alignment"/"volume_refinement", "scorer": {"type": "openvdb_grid"}/' "$folder/two.json" >"$folder/openvdb.json"
"$folder/moved/bin/croon" run "$folder/openvdb.json" --out "$folder/openvdb" --quiet >/dev/null || fail 'the program does not find OpenVDB'
mv "$folder/moved" "$folder/prefix"
"$croon" validate "$folder/prefix/share/croon/experiments" >/dev/null || fail 'an installed experiment cannot be read'
"$croon" simulate "$folder/two.json" --out "$folder/scenes" --quiet >/dev/null
answer=$("$calibrate" "$pipeline" "$folder/scenes/000000/top.pcd" "$folder/scenes/000000/left.pcd")
# A rotation, a translation and a matrix of six by six.
[[ $(wc -w <<<"$answer") == 48 ]] || fail "the program printed: $answer"
if [[ -n ${CROON_DATA:-} && -d $CROON_DATA/opencalib/real ]]; then
  clouds=("$(find "$CROON_DATA/opencalib/real" -name 'top*.pcd' | sort | head -1)"
    "$(find "$CROON_DATA/opencalib/real" -name 'left*.pcd' | sort | head -1)")
  answer=$("$calibrate" "$pipeline" "${clouds[@]}")
  [[ $(wc -w <<<"$answer") == 48 ]] || fail "the program printed for ${clouds[*]}: $answer"
fi

# The Python package, without the build and the sources.
python=${3:-}
if [[ -n $python ]]; then
  packages=$(echo "$folder"/prefix/lib/python3.*/site-packages)
  (cd "$folder" && PYTHONPATH=$packages "$python" -B - "$pipeline" "$packages") <<'END' || fail 'the Python package does not run'
import pathlib, sys
import croon
assert pathlib.Path(croon.__file__).parents[1] == pathlib.Path(sys.argv[2])
for name in ("_core.pyi", "py.typed"):
    assert pathlib.Path(croon.__file__).with_name(name).exists(), name
top, left = (croon.read_cloud(f"scenes/000000/{sensor}.pcd") for sensor in ("top", "left"))
assert croon.Pipeline(sys.argv[1]).run(top, left).pose.shape == (4, 4)
END
fi

# A paper's repository.
cp -r "$source/docs/example_paper" "$folder/paper"
build_project "$folder/paper"
paper=$folder/paper/build/croon
for stage in icp/median_trimmed overlap_measure/nearest step/overlap_verdict icp/trimmed dataset/simulated; do
  "$paper" stages "$stage" >/dev/null || fail "the program lacks $stage"
done
"$paper" stages step/overlap_verdict | grep -q 'Provides the extra overlap_ratio' || fail 'help lacks the extra'
"$paper" run "$folder/paper/experiments/median_trimmed.json" --trials 1 --out "$folder/results" --quiet >/dev/null
grep -q '^median_trimmed,.*,overlap_verdict,overlap_ratio,' "$folder/results/diagnostics.csv" ||
  fail 'diagnostics.csv lacks the overlap'
grep -q "\"folder\": \"$folder/paper\"" "$folder/results/manifest.json" || fail 'the manifest lacks the paper'

# As a part of another project: neither program nor tests.
mkdir "$folder/part"
cp "$folder/calibrate_two/calibrate_two.cpp" "$folder/part"
cat >"$folder/part/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.22)
project(part LANGUAGES CXX)
add_subdirectory("$source" croon EXCLUDE_FROM_ALL)
add_executable(calibrate_two calibrate_two.cpp)
target_link_libraries(calibrate_two PRIVATE croon::croon)
if(TARGET croon OR TARGET croon_store OR TARGET croon_simulation OR TARGET test_framework)
  message(FATAL_ERROR "a part of a project builds the program or the tests")
endif()
END
cmake -S "$folder/part" -B "$folder/part/build" -G Ninja -DCMAKE_BUILD_TYPE=Release >"$folder/part.log" 2>&1 ||
  { cat "$folder/part.log" >&2; fail 'add_subdirectory does not configure'; }
# The program sees the headers. Building all of croon a second time would take minutes.
cmake --build "$folder/part/build" --target CMakeFiles/calibrate_two.dir/calibrate_two.cpp.o >>"$folder/part.log" 2>&1 ||
  { tail -n 40 "$folder/part.log" >&2; fail 'a part of a project does not compile'; }
echo 'The installed package builds what docs/library.md shows.'
