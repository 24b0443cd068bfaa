"""Builds the Python package with CMake, for `pip install .`.

The libraries that croon is built with must be installed (.ci/install_packages). Environment variables:

CMAKE_ARGS       more arguments of cmake, such as -DCROON_WITH_CGAL=OFF
CMAKE_BUILD_PARALLEL_LEVEL  number of jobs
CROON_BUILD_DIR  a build folder with CROON_WITH_PYTHON=ON: its module is packaged as it is, and nothing is built.
                 Without it, the build is in build/python and stays there: the next one compiles what has changed.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent
BUILD = SOURCE / "build"


class BuildWithCMake(build_ext):
    """Puts croon._core where setuptools expects the extension."""

    def run(self):
        given = os.environ.get("CROON_BUILD_DIR")
        folder = pathlib.Path(given) if given else build(BUILD / "python")
        module = folder / "python" / "croon" / ("_core" + sysconfig.get_config_var("EXT_SUFFIX"))
        if not module.is_file():
            sys.exit(f"{folder}: expected a build with CROON_WITH_PYTHON=ON for this Python, found no {module.name}")
        target = pathlib.Path(self.get_ext_fullpath("croon._core"))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(module, target)

    def get_outputs(self):
        return [self.get_ext_fullpath("croon._core")]


def build(folder):
    """Configures and builds the module in `folder`, which is returned."""
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DCROON_WITH_PYTHON=ON", "-DCROON_BUILD_TESTS=OFF",
               f"-DPython3_EXECUTABLE={sys.executable}", *shlex.split(os.environ.get("CMAKE_ARGS", ""))]
    subprocess.run(["cmake", "-S", SOURCE, "-B", folder, *generator, *options], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "croon_python"], check=True)
    return folder


BUILD.mkdir(exist_ok=True)  # For what setuptools writes beside the wheel.
setup(
    version=re.search(r"project\(croon VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))[1],
    packages=["croon"],
    package_dir={"croon": "experiments/python/croon"},
    package_data={"croon": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("croon._core", sources=[])],
    cmdclass={"build_ext": BuildWithCMake},
    options={"egg_info": {"egg_base": "build"}},
    zip_safe=False,
)
