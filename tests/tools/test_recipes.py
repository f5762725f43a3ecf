"""Recipes, citation and changelog: one version everywhere, and the dependencies that CMake and the package look for."""
import collections
import contextlib
import os
import pathlib
import re
import sys
import tomllib
import types
import unittest
import unittest.mock

import yaml

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "tools"))
import rubatlas  # noqa: E402

CMAKE = (ROOT / "CMakeLists.txt").read_text()
PROJECT = tomllib.loads((ROOT / "tools/pyproject.toml").read_text())
RECIPE = yaml.safe_load((ROOT / "jobs/conda/recipe.yaml").read_text())
# What CMake looks for: its name in Spack, and in conda.
NAMES = {"MPI": ("mpi", "openmpi"), "HDF5": ("hdf5", "hdf5"), "ZLIB": ("zlib-api", "zlib"),
         "Eigen3": ("eigen", "eigen"), "nlohmann_json": ("nlohmann-json", "nlohmann_json"),
         "CLI11": ("cli11", "cli11"), "fmt": ("fmt", "fmt"), "Boost": ("boost", "libboost-headers"),
         "PkgConfig": ("pkgconfig", "pkg-config"), "fftw3": ("fftw", "fftw")}


def looked_for():
    """What the build looks for, with the least version where it names one; tests aside."""
    found = re.findall(r"^(?:find_package\((\w+)|pkg_check_modules\(\w+ .*\b(\w+)\))(?: ([0-9.]+))?", CMAKE, re.M)
    return {package or module: version for package, module, version in found}


def needed_by_tools():
    """What the Python package needs, with the least version."""
    return dict(re.match(r"([\w-]+)(?:>=)?([0-9.]*)", one).groups() for one in PROJECT["project"]["dependencies"])


def spack_recipe():
    """Calls of Spack's directives in the recipe, by directive, and the class of the recipe."""
    calls = collections.defaultdict(list)
    spack = types.ModuleType("spack.package")
    for name in ("license", "version", "variant", "depends_on", "extends"):
        setattr(spack, name, lambda *given, directive=name, **_: calls[directive].append(given[0]))
    spack.when = contextlib.nullcontext
    spack.CMakePackage = type("CMakePackage", (), {"define": staticmethod(lambda name, value: f"-D{name}={value}")})
    modules = {"spack": types.ModuleType("spack"), "spack.package": spack}
    path = ROOT / "jobs/spack/packages/rubatlas/package.py"
    names = {}
    with unittest.mock.patch.dict(sys.modules, modules):
        exec(compile(path.read_text(), path, "exec"), names)
    return calls, names["Rubatlas"]


def conda_packages(place):
    """Name and least version of what the conda recipe requires at `place`."""
    parts = (one.split() for one in RECIPE["requirements"][place] if not one.startswith("$"))
    return {name: "".join(rest).removeprefix(">=") for name, *rest in parts}


class Recipes(unittest.TestCase):
    def test_every_file_that_states_the_version_states_the_same(self):
        citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
        changes = re.findall(r"^## \[([^]]+)\]", (ROOT / "CHANGELOG.md").read_text(), re.M)
        self.assertEqual(changes[0], "Unreleased")
        versions = {"CMakeLists.txt": re.search(r"project\(rubatlas VERSION ([0-9.]+)", CMAKE)[1],
                    "CITATION.cff": citation["version"], "CHANGELOG.md": changes[1], "tools": rubatlas.__version__,
                    "spack": spack_recipe()[0]["version"][0], "conda": RECIPE["context"]["version"]}
        self.assertEqual(set(versions.values()), {versions["CMakeLists.txt"]}, versions)
        self.assertEqual(PROJECT["project"]["dynamic"], ["version"])
        self.assertEqual(PROJECT["tool"]["setuptools"]["dynamic"]["version"], {"attr": "rubatlas.__version__"})

    def test_the_licence_is_the_same_everywhere(self):
        self.assertTrue((ROOT / "LICENSE").read_text().startswith("MIT License"))
        self.assertEqual((ROOT / "tools/LICENSE").read_text(), (ROOT / "LICENSE").read_text())
        citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
        self.assertEqual({citation["license"], PROJECT["project"]["license"]["text"], spack_recipe()[0]["license"][0],
                          RECIPE["about"]["license"]}, {"MIT"})

    def test_the_citation_has_what_its_format_asks_for_and_the_paper(self):
        citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
        self.assertEqual(citation["cff-version"], "1.2.0")
        self.assertLessEqual({"message", "title", "authors"}, set(citation))
        paper, = citation["references"]
        self.assertLessEqual({"type", "title", "authors"}, set(paper))
        self.assertIn(paper["doi"], (ROOT / "src/model.md").read_text())
        for one in [*citation["authors"], *paper["authors"]]:
            self.assertIn(set(one), ({"name"}, {"family-names", "given-names"}))

    def test_spack_installs_what_is_looked_for(self):
        calls, recipe = spack_recipe()
        wanted = {NAMES[name][0]: version for name, version in looked_for().items()}
        wanted |= {"cmake": re.search(r"cmake_minimum_required\(VERSION ([0-9.]+)", CMAKE)[1], "fftw": "3"}
        wanted |= {"c": "", "cxx": ""}
        wanted |= {f"py-{name}": version for name, version in needed_by_tools().items()}
        wanted |= {"py-pip": "", "py-setuptools": PROJECT["build-system"]["requires"][0].removeprefix("setuptools>=")}
        stated = {re.match(r"[\w-]+", one)[0]: re.search(r"(?:@([0-9.]+):)?$", one)[1] or ""
                  for one in calls["depends_on"]}
        self.assertEqual(stated, wanted)
        self.assertEqual(calls["extends"], [f"python@{PROJECT['project']['requires-python'].removeprefix('>=')}:"])
        self.assertIn("+mpi", next(one for one in calls["depends_on"] if one.startswith("hdf5")))
        self.assertEqual(recipe().cmake_args(), ["-DRUBATLAS_TESTS=False"])
        self.assertIn("option(RUBATLAS_TESTS ", CMAKE)
        repository = yaml.safe_load((ROOT / "jobs/spack/repo.yaml").read_text())
        self.assertEqual(repository["repo"]["namespace"], "rubatlas")

    def test_conda_installs_what_is_looked_for(self):
        built = conda_packages("build") | conda_packages("host")
        for name, version in looked_for().items():
            self.assertIn(NAMES[name][1], built)
            if version:
                self.assertEqual(built[NAMES[name][1]], version)
        self.assertIn("mpi_openmpi", built["hdf5"])
        run = conda_packages("run")
        run["matplotlib"] = run.pop("matplotlib-base")  # without a toolkit for windows
        self.assertEqual({name: run[name] for name in set(run) - {"openmpi", "python"}}, needed_by_tools())
        self.assertEqual((ROOT / "jobs/conda" / RECIPE["source"]["path"]).resolve(), ROOT.resolve())


if __name__ == "__main__":
    unittest.main()
