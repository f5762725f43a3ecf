"""The package as a package: it installs without a network, its types and its examples hold, its tour runs."""
import ast
import doctest
import email
import importlib
import json
import os
import pathlib
import pkgutil
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
TINY = PROGRAM.parent / "tests/tiny_atlas"
TOOLS = ROOT / "tools"
CACHE = PROGRAM.parent / "tests/mypy"  # of the types, from one run to the next
sys.path.insert(0, str(TOOLS))
import rubatlas  # noqa: E402

# What is meant to be imported by others has types throughout; the modules behind it are checked where they have them.
TYPED = ("__init__", "atlas", "commands", "program", "query", "signature", "plots/axes")


def imported(path):
    """Names of the modules that a file imports, wherever in it; of `from a import b` a.b where that is one, else a."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {one.name for one in node.names}
        elif isinstance(node, ast.ImportFrom):
            below = {f"{node.module}.{one.name}" for one in node.names}
            there = {one for one in below if (TOOLS / f"{one.replace('.', '/')}.py").is_file()}
            names |= below if there == below else {*there, node.module}
    return names


def modules():
    """Names of all modules of the package but the report's."""
    return [found.name for found in pkgutil.walk_packages(rubatlas.__path__, "rubatlas.")
            if not found.name.startswith("rubatlas.report")]


class Package(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def expect_success(self, *command, **options):
        ended = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False, **options)
        self.assertEqual(ended.returncode, 0, ended.stdout[-3000:] + ended.stderr[-3000:])
        return ended.stdout

    def test_a_wheel_holds_what_the_package_needs_and_is_installed_without_a_network(self):
        shutil.copytree(TOOLS, self.folder / "tools")
        self.expect_success("/usr/bin/python3", "-m", "pip", "wheel", "-q", "--no-build-isolation", "--no-index",
                            "--no-deps", "-w", self.folder, self.folder / "tools")
        wheel, = self.folder.glob("*.whl")
        with zipfile.ZipFile(wheel) as archive:
            held = set(archive.namelist())
            about = email.message_from_string(
                archive.read(f"rubatlas-{rubatlas.__version__}.dist-info/METADATA").decode())
        wanted = [path for path in (TOOLS / "rubatlas").rglob("*.*")
                  if path.suffix in (".py", ".js", ".html", ".css", ".json")
                  and path.name not in ("package.json", "package-lock.json")]  # where uPlot comes from
        self.assertGreater(len(wanted), 45)
        self.assertLessEqual({str(path.relative_to(TOOLS)) for path in wanted}, held)
        about_it = f"rubatlas-{rubatlas.__version__}.dist-info"
        # Where setuptools puts it has changed.
        self.assertTrue(held & {f"{about_it}/LICENSE", f"{about_it}/licenses/LICENSE"})
        self.assertEqual(about.get_payload(), (TOOLS / "README.md").read_text())
        needed = {re.match(r"[A-Za-z0-9_-]+", line)[0] for line in about.get_all("Requires-Dist")
                  if "extra ==" not in line}
        roots = {name.split(".")[0] for path in (TOOLS / "rubatlas").rglob("*.py") for name in imported(path)}
        self.assertEqual(needed, roots - set(sys.stdlib_module_names) - {"rubatlas"})

        # The commands run from what was installed, in a fresh environment, with nothing of the source around.
        shutil.rmtree(self.folder / "tools")
        self.expect_success("/usr/bin/python3", "-m", "venv", "--system-site-packages", "--without-pip",
                            self.folder / "venv")
        venv = self.folder / "venv/bin"
        self.expect_success(venv / "python", "-m", "pip", "install", "-q", "--no-index", "--no-compile", wheel)
        elsewhere = {"cwd": self.folder, "env": {**os.environ, "PYTHONPATH": ""}}
        found = self.expect_success(venv / "python", "-c", "import rubatlas, sys; print(rubatlas.__file__); "
                                    "print(len(rubatlas.open(sys.argv[1])))", TINY / "atlas.h5", **elsewhere).split()
        self.assertTrue(pathlib.Path(found[0]).is_relative_to(self.folder / "venv"))
        self.assertEqual(int(found[1]), len(rubatlas.open(TINY / "atlas.h5")))
        self.expect_success(venv / "rubatlas-plot", "displacement", TINY / "atlas.h5", "-o", self.folder / "a.svg",
                            **elsewhere)
        self.assertIn(b"<svg", (self.folder / "a.svg").read_bytes())
        self.expect_success(venv / "rubatlas-report", TINY / "atlas.h5", "-o", self.folder / "a.html",
                            "--without-solver", "--orbits", "3", **elsewhere)
        self.assertGreater((self.folder / "a.html").stat().st_size, 200_000)

    def test_types_agree_and_are_complete_in_what_others_import(self):
        typed = ",".join("rubatlas." + name.replace("/", ".") if name != "__init__" else "rubatlas" for name in TYPED)
        rules = self.folder / "mypy.ini"
        # What --strict asks for, but for calls of modules without types; what others have written is not checked.
        rules.write_text(f"""[mypy]
ignore_missing_imports = True
no_implicit_optional = True
warn_redundant_casts = True
[mypy-rubatlas.*]
check_untyped_defs = True
[mypy-{typed}]
disallow_any_generics = True
disallow_incomplete_defs = True
disallow_subclassing_any = True
disallow_untyped_decorators = True
disallow_untyped_defs = True
strict_concatenate = True
strict_equality = True
warn_return_any = True
warn_unused_ignores = True
""")
        self.expect_success("/usr/bin/python3", "-m", "mypy", "--config-file", rules, "--cache-dir", CACHE,
                            "rubatlas", cwd=TOOLS)

    def test_everything_that_the_package_offers_is_listed_and_described(self):
        offered = set(rubatlas.__all__)
        self.assertLessEqual({"open", "run", "branch", "edges", "verify", "accuracy", "merge"}, offered)
        # In a process of its own, where nothing has been imported by other tests.
        listed, *described = self.expect_success(
            "/usr/bin/python3", "-c", "import rubatlas; print(dir(rubatlas)); help(rubatlas)", cwd=TOOLS).splitlines()
        self.assertLessEqual(offered, set(ast.literal_eval(listed)))
        for name in offered - {"Atlas", "AtlasError"}:
            self.assertTrue(any(line.strip().startswith(f"{name}(") for line in described), name)
            self.assertTrue(getattr(rubatlas, name).__doc__)
        self.assertIn("    class Atlas(builtins.object)", described)

    def test_the_examples_of_all_modules_hold(self):
        examples = 0
        for name in modules():
            with self.subTest(module=name):
                result = doctest.testmod(importlib.import_module(name))
                self.assertEqual(result.failed, 0)
                examples += result.attempted
        self.assertGreaterEqual(examples, 5)

    def test_no_module_imports_one_that_imports_it(self):
        names = {path: ".".join(path.relative_to(TOOLS).with_suffix("").parts).removesuffix(".__init__")
                 for path in (TOOLS / "rubatlas").rglob("*.py")}
        imports = {name: imported(path) & set(names.values()) for path, name in names.items()}
        self.assertGreater(sum(map(len, imports.values())), 50)
        for name in sorted(names.values()):
            reached, ahead = set(), [name]
            while ahead:
                further = imports[ahead.pop()] - reached
                reached |= further
                ahead += further
            self.assertNotIn(name, reached)

    def test_nothing_in_the_package_imports_from_the_tests(self):
        sources = list((TOOLS / "rubatlas").rglob("*.py"))
        self.assertGreater(len(sources), 20)
        for source in sources:
            self.assertNotRegex(source.read_text(), r"(?m)^\s*(from|import) tests\b", str(source))

    def test_the_tour_runs_from_its_first_cell_to_its_last(self):
        (self.folder / "tools").mkdir()
        shutil.copy(TOOLS / "tour.ipynb", self.folder / "tools")
        (self.folder / "tools/rubatlas").symlink_to(TOOLS / "rubatlas")
        (self.folder / "atlases").mkdir()
        for name, source in (("quick.h5", "atlas.h5"), ("quick_maps.h5", "maps.h5")):
            shutil.copy(TINY / source, self.folder / "atlases" / name)
        ran = json.loads(self.expect_success("/usr/bin/python3", "-m", "nbconvert", "--to", "notebook", "--execute",
                                             "--stdout",
                                             self.folder / "tools/tour.ipynb", cwd=self.folder,
                                             env={**os.environ, "HOME": str(self.folder),
                                                  "JUPYTER_PLATFORM_DIRS": "1"}))
        code = [cell for cell in ran["cells"] if cell["cell_type"] == "code"]
        self.assertGreaterEqual(len(code), 6)
        self.assertGreaterEqual(sum("image/png" in output.get("data", {}) for cell in code
                                    for output in cell["outputs"]), 3)

    def test_the_tour_is_kept_without_its_results(self):
        for cell in json.loads((TOOLS / "tour.ipynb").read_text())["cells"]:
            self.assertFalse(cell.get("outputs") or cell.get("execution_count"))


if __name__ == "__main__":
    unittest.main()
