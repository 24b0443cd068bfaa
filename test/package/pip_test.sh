#!/usr/bin/env bash
# `pip install .` in a copy of the tree, without the network, gives a package that calibrates. The module is that of a build
# that exists: to build it once more would take a quarter of an hour. Usage: pip_test.sh BUILD_FOLDER SOURCE_FOLDER PYTHON;
# ends with 77 without venv or setuptools.
set -euo pipefail

build=$1
source=$2
python=$3
skip() { echo "pip_test: $*" >&2; exit 77; }
fail() { echo "pip_test: $*" >&2; exit 1; }
for module in ensurepip setuptools wheel; do
  "$python" -c "import $module" 2>/dev/null || skip "Python lacks $module"
done

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/tree"
tar -C "$source" --exclude=./build --exclude=./.git --exclude=./data --exclude=./results -cf - . | tar -C "$folder/tree" -xf -
"$python" -m venv --system-site-packages "$folder/venv"
cd "$folder/tree"
if CROON_BUILD_DIR=$folder "$python" setup.py --quiet build_ext >"$folder/log" 2>&1; then fail 'a folder without a build is packaged'; fi
grep -q 'expected a build with CROON_WITH_PYTHON=ON' "$folder/log" || { cat "$folder/log" >&2; fail 'the error is another'; }
CROON_BUILD_DIR=$build "$folder/venv/bin/pip" install --no-build-isolation --no-deps --no-index --disable-pip-version-check . \
  >"$folder/log" 2>&1 || { cat "$folder/log" >&2; fail 'pip does not install the package'; }
[[ -z $(find "$folder/tree" -maxdepth 1 -name '*.egg-info') ]] || fail 'pip leaves files in the tree'
cd "$folder"
env -u PYTHONPATH "$folder/venv/bin/python" -B - "$folder/venv" <<'END' || fail 'the package does not run'
import importlib.metadata, pathlib, sys
import croon
folder = pathlib.Path(croon.__file__).parent
assert pathlib.Path(sys.argv[1]).resolve() in folder.resolve().parents, folder
assert croon.__version__.startswith(importlib.metadata.version("croon")), croon.__version__
assert all((folder / name).exists() for name in ("_core.pyi", "py.typed"))
assert "best" in croon.pipelines()
END
echo 'pip installs the package from a copy of the tree.'
