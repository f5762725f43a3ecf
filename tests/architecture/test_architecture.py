"""Who may include whom, where the big libraries may be seen, and what every folder owes to its reader."""
import graphlib
import os
import pathlib
import re
import unittest

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])

# The one table of who depends on whom, in the order of the flow: a folder sees itself and what stands here, a folder
# with all that is in it or one header. The folder that it lies in stands for the files there, not for the folders
# beside it.
LAWS = [f"collocation/{name}.hpp" for name in ("law", "tip_places", "axial_law", "damped_law", "inclined_law",
                                              "rigid_law")]
MAY_INCLUDE = {
    "src/settings/effects": ["settings/range.hpp"],
    "src/settings": ["settings/effects"],
    "src/plan": ["settings"],
    "src/integrate": [],
    "src/blade": ["integrate"],
    "src/ending": [],
    "src/trajectory": ["integrate"],
    "src/contact": ["blade", "integrate"],
    "src/rotor": ["contact/pose.hpp", "contact/tip.hpp", "settings/effects", "integrate"],
    "src/collocation": ["blade", "contact", "rotor", "integrate"],
    "src/variation": ["settings", "blade", "contact", "rotor", "integrate", "trajectory"],
    "src/observables": ["settings", "integrate", "trajectory", "variation"],
    "src/modes": ["blade", "contact", "rotor", "integrate", "collocation", "trajectory", "ending"],
    "src/motion": ["settings", "rotor", "trajectory", "modes", "ending"],
    "src/point": ["settings", "rotor", "trajectory", "variation", "observables", "modes/motion_listener.hpp",
                  "modes/work_meter.hpp", "motion", "ending", "integrate/decompositions.hpp"],
    "src/assembly": ["settings", "plan", "blade", "contact", "rotor", "integrate", *LAWS, "variation", "modes",
                     "motion", "point"],
    "src/compared": ["settings", "contact", "rotor", "integrate", *LAWS, "trajectory", "modes", "motion", "ending",
                     "point", "variation/parts_of_scene.hpp", "assembly"],
    "src/branch": ["settings", "plan", "integrate", "contact/pose.hpp", "rotor", "variation/parts_of_scene.hpp",
                   "observables/grazing.hpp", "point", "assembly"],
    "src/atlas": ["settings", "plan", "observables", "point/line_solver.hpp", "ending", "branch/branch.hpp"],
    "analysis/rules": ["settings", "plan", "rotor/free_motion.hpp", "atlas"],
    "analysis": ["settings", "plan", "atlas", "analysis/rules"],
    "mpi/job": ["settings", "plan", "observables", "modes/work_meter.hpp", "point", "assembly", "atlas",
                "analysis/rules", "mpi"],
    "mpi/accuracy": ["settings", "plan", "observables", "point", "assembly", "atlas/accuracy_file.hpp", "analysis",
                     "mpi"],
    "mpi/commands": ["settings", "plan", "observables", "modes/work_meter.hpp", "point", "assembly", "branch",
                     "atlas", "analysis", "mpi", "mpi/job", "mpi/accuracy"],
    "mpi": ["settings", "atlas", "analysis/analyse.hpp", "mpi/job", "mpi/accuracy", "mpi/commands"],
    "tools/explorer_solver": ["settings", "blade", "motion/point_start.hpp", "observables", "plan", "point",
                             "assembly"],
}


def name_of(folder):
    """The folder as includes spell it."""
    return folder.removeprefix("src/")


# Libraries that stay in their folders, so that they can be exchanged there.
STAYS_IN = {
    "mpi.h": ["mpi", "src/atlas"],
    "hdf5.h": ["src/atlas", "mpi"],
    "hdf5_hl.h": ["src/atlas"],
    "zlib.h": ["src/atlas/row_checksum.cpp"],
    "fftw3.h": ["src/observables/signal_spectrum.cpp"],
    "nlohmann/json.hpp": ["src/settings", "mpi/job/run_record.cpp"],
    "CLI/CLI.hpp": ["mpi"],
    "experimental/simd": ["src/collocation/nodes_in_lanes.hpp"],
}

TOP_LEVEL = {"CMakeLists.txt", "README.md", "LICENSE", "CITATION.cff", "CHANGELOG.md", "src", "mpi", "analysis",
             "tests", "jobs", "tools"}
MADE_HERE = {"build", "atlases"}  # and build-*: none of them is under version control
NAMES_THAT_SAY_NOTHING = {"utils", "util", "helpers", "helper", "manager", "common", "misc", "stuff", "tools"}


def files(*suffixes):
    """The project's own files with one of these suffixes, as paths relative to its root."""
    for folder, folders, names in os.walk(ROOT):
        relative = pathlib.Path(folder).relative_to(ROOT)
        folders[:] = sorted(name for name in folders if not name.startswith((".", "build", "__pycache__")) and
                            name not in MADE_HERE)
        for name in sorted(names):
            if name.endswith(suffixes):
                yield relative / name


def includes(path):
    """Names in the include directives of a file."""
    return re.findall(r'^\s*#\s*include\s*["<]([^">]+)[">]', (ROOT / path).read_text(), re.MULTILINE)


def project_includes(path):
    """The project's own files in the include directives of a file, as paths relative to its root."""
    for name in includes(path):
        for place in ("", "src"):
            if (ROOT / place / name).is_file():  # else it is a library's, or one that the build makes
                yield pathlib.Path(place) / name


def inside(path, place):
    """True when `path` is the file `place` or lies in the folder `place`."""
    return str(path) == place or str(path).startswith(place + "/")


class Architecture(unittest.TestCase):
    def expect_none(self, departures, rule):
        departures = list(departures)
        if departures:
            self.fail(f"{rule}:\n  " + "\n  ".join(departures))

    def test_folders_include_only_what_they_may_depend_on(self):
        departures, seen = [], 0
        for folder, allowed in MAY_INCLUDE.items():
            for path in files(".hpp", ".cpp"):
                if path.parent != pathlib.Path(folder):
                    continue
                for included in project_includes(path):
                    seen += 1
                    name = name_of(str(included))
                    if not any(os.path.dirname(name) == place if inside(name_of(folder), place) else inside(name, place)
                               for place in [name_of(folder), *allowed]):
                        departures.append(f"{path} includes {name}")
        self.assertGreater(seen, 500)
        self.expect_none(departures, "a folder includes only what MAY_INCLUDE allows")

    def test_every_source_folder_has_its_line_in_the_table(self):
        found = {str(path.parent) for path in files(".hpp", ".cpp") if path.parts[0] != "tests"}
        self.assertEqual(found, set(MAY_INCLUDE))

    def test_the_table_is_in_the_order_of_dependence(self):
        order = [name_of(folder) for folder in MAY_INCLUDE]
        for folder, allowed in MAY_INCLUDE.items():
            for name in allowed:
                place = os.path.dirname(name) if name.endswith(".hpp") else name
                if not inside(name_of(folder), place):
                    self.assertLess(order.index(place), order.index(name_of(folder)), f"{folder} before {name}")

    def test_folders_include_each_other_in_no_circle(self):
        # Every include counts, except between a folder and one that lies in it.
        graph = {folder: set() for folder in MAY_INCLUDE}
        for path in files(".hpp", ".cpp"):
            folder = str(path.parent)
            if folder in graph:
                others = {str(included.parent) for included in project_includes(path)}
                graph[folder] |= {other for other in others if not inside(folder, other) and not inside(other, folder)}
        self.assertGreater(sum(map(len, graph.values())), 80)
        try:
            list(graphlib.TopologicalSorter(graph).static_order())
        except graphlib.CycleError as error:
            self.fail("folders include each other in a circle: " + " <- ".join(error.args[1]))

    def test_big_libraries_stay_in_their_folders(self):
        departures = [f"{path} includes {name}, which stays in {', '.join(STAYS_IN[name])}"
                      for path in files(".hpp", ".cpp") if path.parts[0] != "tests"
                      for name in includes(path)
                      if name in STAYS_IN and not any(inside(path, place) for place in STAYS_IN[name])]
        self.expect_none(departures, "big libraries stay in their folders")

    def test_every_source_includes_its_own_header_first(self):
        sources = [path for path in files(".cpp") if path.parts[0] != "tests"
                   and (ROOT / path).with_suffix(".hpp").exists()]
        self.assertGreater(len(sources), 50)
        self.expect_none((f"{path} begins with {includes(path)[0]}" for path in sources
                          if includes(path)[0] != str(path.with_suffix(".hpp")).removeprefix("src/")),
                         "a header's own source shows that it compiles alone")

    def test_names_say_what_is_inside(self):
        names = [path for path in files(".hpp", ".cpp", ".py", ".sh") if path.stem in NAMES_THAT_SAY_NOTHING]
        self.expect_none(map(str, names), "a file is named after its subject")

    def test_sources_are_named_in_snake_case(self):
        names = [path for path in files(".hpp", ".cpp", ".py", ".sh") if not re.fullmatch(r"[a-z0-9_]+", path.stem)]
        self.expect_none(map(str, names), "files are named in snake_case")

    def test_every_header_is_guarded_and_opens_with_what_it_is(self):
        for path in files(".hpp"):
            text = (ROOT / path).read_text()
            with self.subTest(path=str(path)):
                self.assertEqual(text.count("#pragma once"), 1)
                self.assertTrue(text.startswith("//"), "its first line says what it is")

    def test_every_folder_has_a_readme(self):
        folders = {ROOT / folder for folder in [*MAY_INCLUDE, "src", "tests", "tests/reference", "jobs", "tools"]}
        missing = sorted(str(folder.relative_to(ROOT)) for folder in folders if not (folder / "README.md").is_file())
        self.expect_none(missing, "every folder has a README.md")

    def test_links_in_pages_lead_to_files(self):
        link = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")
        links = [(path, target) for path in files(".md") for target in link.findall((ROOT / path).read_text())]
        self.assertGreater(len(links), 50)
        self.expect_none((f"{path} links to {target}" for path, target in links
                          if not ((ROOT / path).parent / target).exists()), "a link leads to a file of the project")

    def test_the_tests_readme_names_every_suite(self):
        text = (ROOT / "tests" / "README.md").read_text()
        suites = sorted(path.parent.name for path in files("CMakeLists.txt") if inside(path.parent.parent, "tests"))
        self.assertGreater(len(suites), 8)
        self.expect_none((suite for suite in suites if f"`{suite}/`" not in text), "tests/README.md names every suite")

    def test_the_top_level_holds_nothing_else(self):
        there = {path.name for path in ROOT.iterdir() if not path.name.startswith((".", "build")) and
                 path.name not in MADE_HERE}
        self.assertEqual(there, TOP_LEVEL)

    def test_no_file_names_a_place_on_one_machine(self):
        place = re.compile(r"(?<![\w.])/(home|work|root|Users)/\w")
        departures = [f"{path}: {line.strip()}" for path in files(".hpp", ".cpp", ".py", ".sh", ".md", ".txt", ".json")
                      for line in (ROOT / path).read_text().splitlines() if place.search(line)]
        self.expect_none(departures, "nothing names a place on one machine")

    def test_comments_cite_only_what_a_reader_can_have(self):
        # Sections of the model and of published papers; design notes of the authors are not part of the project.
        note = re.compile(r"\bDESIGN(\.md)?\b ?[AB]?\d?|\bSTYLE\.md\b")
        departures = [f"{path}: {line.strip()}" for path in files(".hpp", ".cpp", ".py", ".sh", ".md", ".txt")
                      if path.name != "test_architecture.py"
                      for line in (ROOT / path).read_text().splitlines() if note.search(line)]
        self.expect_none(departures, "comments cite the model or a publication")

    def test_texts_that_users_see_cite_no_section_of_a_page(self):
        # Comments may: a text says what it means, since its reader has not the page at hand.
        cited = re.compile(r"\bMODEL \d")
        departures = []
        for path in files(".hpp", ".cpp", ".py", ".sh", ".json"):
            if path.parts[0] == "tests":
                continue
            for line in (ROOT / path).read_text().splitlines():
                comment = "//" if path.suffix in (".hpp", ".cpp") else "#" if path.suffix in (".py", ".sh") else None
                if cited.search(line.split(comment)[0] if comment else line):
                    departures.append(f"{path}: {line.strip()}")
        self.expect_none(departures, "a message, a help text, a title says what it means")

    def test_every_cited_section_of_the_model_is_on_the_model_page(self):
        headings = re.findall(r"^##+ (\d+(?:\.\d+)?) ", (ROOT / "src/model.md").read_text(), re.MULTILINE)
        self.assertGreater(len(headings), 20)
        self.assertEqual(len(headings), len(set(headings)), "no section number stands twice")
        citation = re.compile(r"\bMODEL (\d+(?:\.\d+)?(?:(?:, | and | to )\d+(?:\.\d+)?)*)")
        cited = [(path, number) for path in files(".hpp", ".cpp", ".py", ".sh", ".md", ".txt", ".json")
                 for sections in citation.findall(" ".join((ROOT / path).read_text().split()).replace(" /// ", " "))
                 for number in re.findall(r"\d+(?:\.\d+)?", sections)]
        self.assertGreater(len(cited), 100)
        self.expect_none((f"{path} cites section {number}" for path, number in cited if number not in headings),
                         "a cited section of the model is a heading of src/model.md")


if __name__ == "__main__":
    unittest.main()
