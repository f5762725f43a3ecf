"""Bands of safe speeds: what the tool says is what the atlas holds."""
import contextlib
import io
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import h5py
import numpy as np

ROOT = pathlib.Path(os.environ["RUBATLAS_SOURCE_DIR"])
TINY = pathlib.Path(os.environ["RUBATLAS_PROGRAM"]).parent / "tests/tiny_atlas"
sys.path.insert(0, str(ROOT / "tests/support"))
from bands import in_bands  # noqa: E402
from forked_commands import ended_command  # noqa: E402
from rubatlas import style  # noqa: E402
from rubatlas.plots import safe_speeds  # noqa: E402
PROGRAM = pathlib.Path(os.environ["RUBATLAS_PROGRAM"])
DONE, APERIODIC = 1, 255
NATURAL_FREQUENCY = 10.0  # rad/s, of the default rotor


class SafeSpeeds(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def words(self, *arguments, atlas=TINY / "atlas.h5"):
        return list(map(str, (atlas, "-o", self.folder / "safe.png", *arguments)))

    def said(self, *arguments, **more):
        """Exit code, output and errors of the command in this process, for what it says and not what it draws."""
        output, errors, code = io.StringIO(), io.StringIO(), 0
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors), \
                unittest.mock.patch.object(safe_speeds, "draw_picture"):
            try:
                safe_speeds.main(self.words(*arguments, **more))
            except SystemExit as end:
                code = end.code
        return code, output.getvalue(), errors.getvalue()

    def bands(self, *arguments, drawn=False, **more):
        """Bands as a file and in words; `drawn`: of a process that draws the picture, too."""
        arguments = "--json", self.folder / "safe.json", *arguments
        if drawn:
            ended = ended_command("rubatlas-plot", "safe_speeds", *self.words(*arguments, **more))
            code, text, errors = ended.returncode, ended.stdout, ended.stderr
            self.assertTrue((self.folder / "safe.png").read_bytes().startswith(b"\x89PNG"))
        else:
            code, text, errors = self.said(*arguments, **more)
        self.assertEqual((code, errors), (0, ""))
        return json.loads((self.folder / "safe.json").read_text()), text

    def speeds_in(self, result):
        with h5py.File(TINY / "atlas.h5") as atlas:
            speed = atlas["speed_ratio"][...]
        inside = np.zeros(len(speed), dtype=bool)
        for band in result["bands"]:
            part = (speed >= band["from"]) & (speed <= band["to"])
            self.assertEqual(part.sum(), band["points"])
            inside |= part
        return inside

    def test_bands_are_the_speeds_at_which_every_line_keeps_every_limit(self):
        result, _ = self.bands("--keep", "max_displacement<=0.008", "--keep", "max_contact_force<=200", drawn=True)
        with h5py.File(TINY / "atlas.h5") as atlas:
            kept = (atlas["status"][...] == DONE) & (atlas["max_displacement"][...] <=
                                                     0.008) & (atlas["max_contact_force"][...] <= 200)
        safe = kept.reshape(-1, kept.shape[-1]).all(axis=0)
        self.assertTrue(0 < safe.sum() < len(safe))
        np.testing.assert_array_equal(self.speeds_in(result), in_bands(safe))

    def test_a_named_value_leaves_out_the_other_lines(self):
        result, _ = self.bands("--keep", "max_displacement<=0.008", "--damping_ratio", "0.2")
        with h5py.File(TINY / "atlas.h5") as atlas:
            line = (0, 0, 0, 2)
            safe = (atlas["status"][line] == DONE) & (atlas["max_displacement"][line] <= 0.008)
        self.assertEqual(result["lines"], 1)
        np.testing.assert_array_equal(self.speeds_in(result), in_bands(safe))

    def test_the_margin_is_the_percentage_of_speed_to_either_end(self):
        result, text = self.bands("--keep", "max_displacement<=0.008", "--damping_ratio", "0.1")
        band = result["bands"][0]
        again, _ = self.bands("--keep", "max_displacement<=0.008", "--damping_ratio", "0.1", "--operate",
                              band["middle"])
        self.assertAlmostEqual(again["operate"]["below_percent"], band["margin_percent"], places=9)
        self.assertAlmostEqual(again["operate"]["above_percent"], band["margin_percent"], places=9)
        self.assertIn(f"±{band['margin_percent']:.1f} %", text)
        self.assertEqual(band["above"]["broken"], ["max_displacement ≤ 8 mm"])
        self.assertTrue(band["below"]["open"], "the grid begins there")

    def test_limits_on_margin_and_class_are_those_of_the_maps(self):
        result, _ = self.bands("--maps", TINY / "maps.h5", "--keep", "class<=1", "--keep", "margin>=0.03",
                               "--damping_ratio", "0.1", drawn=True)
        with h5py.File(TINY / "maps.h5") as maps:
            line = (0, 0, 0, 1)
            margin = maps["margins/along_speed_ratio"][line]
            safe = (maps["class"][line] <= 1) & (maps["class"][line] > 0) & ~(margin < 0.03)
        self.assertGreater(safe.sum(), 0)
        np.testing.assert_array_equal(self.speeds_in(result), in_bands(safe))

    def test_a_miss_that_does_not_occur_keeps_its_limit(self):
        result, _ = self.bands("--keep", "nearest_miss>=1e9", drawn=True)
        with h5py.File(TINY / "atlas.h5") as atlas:
            safe = ((atlas["status"][...] == DONE) & np.isnan(atlas["nearest_miss"][...])).reshape(3, -1).all(axis=0)
        np.testing.assert_array_equal(self.speeds_in(result), in_bands(safe))

    def test_a_limit_has_a_unit_and_is_said_in_those_of_its_reader(self):
        plain, _ = self.bands("--keep", "max_displacement<=0.008")
        for limit in ("max_displacement<=8 mm", "max displacement ≤ 0.8 clearances", "max_displacement <= 8e3 µm"):
            result, text = self.bands("--keep", limit)
            self.assertEqual(result["bands"], plain["bands"], limit)
            self.assertIn("max_displacement ≤ 8 mm, 0.8 clearances", text)
            named = {key: result["limits"][0][key] for key in ("text", "name", "sign", "units")}
            self.assertEqual(named, {"text": "max_displacement ≤ 8 mm, 0.8 clearances", "name": "max_displacement",
                                     "sign": "<=", "units": "m"})
            self.assertAlmostEqual(result["limits"][0]["bound"], 0.008, places=15)

    def test_a_limit_in_a_wrong_unit_is_noted_to_limit_nothing(self):
        with h5py.File(TINY / "atlas.h5") as atlas:
            most = atlas["max_displacement"][...][atlas["status"][...] == DONE].max()
        note = "max_displacement ≤ 2500 mm, 250 clearances limits nothing: the largest value is "
        result, text = self.bands("--keep", "max_displacement<=2.5")
        self.assertTrue(result["notes"][0].startswith(f"{note}{1e3 * most:g} mm"), result["notes"])
        self.assertIn(f"note: {note}", text)
        for limit in ("max_displacement<=0.012", "nearest_miss>=1 mm", "max_displacement<=0.1 mm"):
            self.assertNotIn("limits nothing", self.bands("--keep", limit)[1])
        shutil.copy(TINY / "atlas.h5", self.folder / "atlas.h5")
        with h5py.File(self.folder / "atlas.h5", "r+") as atlas:
            atlas["nearest_miss"][...] = np.nan
        self.assertIn("limits nothing: no point has a nearest_miss",
                      self.bands("--keep", "nearest_miss>=1 mm", atlas=self.folder / "atlas.h5", drawn=True)[1])
        self.assertIn("nearest_miss ≥ 1e-17 mm", self.bands("--keep", "nearest_miss>=1e-20")[0]["notes"][0])

    def test_one_speed_alone_is_no_band(self):
        with h5py.File(TINY / "atlas.h5") as atlas:
            speeds, done = atlas["speed_ratio"][...], atlas["status"][0, 0, 0, 1] == DONE
            largest = atlas["max_displacement"][0, 0, 0, 1]
        for limit in np.arange(0.5, 10.0, 0.1).round(1):  # mm; which one leaves one speed alone is the motion's to say
            safe = done & (largest <= 1e-3 * limit)
            alone = speeds[safe & ~in_bands(safe)]
            if len(alone) == 1:
                break
        self.assertEqual(len(alone), 1)
        result, text = self.bands("--keep", f"max_displacement<={limit} mm", "--damping_ratio", "0.1",
                                  "--operate", alone[0])
        np.testing.assert_array_equal(self.speeds_in(result), in_bands(safe))
        self.assertIn("left out are bands of one speed: 1", text)
        self.assertEqual((result["operate"]["safe"], result["operate"]["broken"]), (False, ["the band is too narrow"]))

    def test_a_band_may_have_a_least_width(self):
        arguments = "--keep", "max_displacement<=8 mm", "--damping_ratio", "0.1"
        every, _ = self.bands(*arguments)
        least = min(band["to"] - band["from"] for band in every["bands"]) + 1e-6
        wider, text = self.bands(*arguments, "--least-width", f"{least * NATURAL_FREQUENCY * 30 / np.pi} rpm")
        self.assertTrue(0 < len(wider["bands"]) < len(every["bands"]))
        self.assertEqual(wider["bands"][0]["from"],
                         next(band["from"] for band in every["bands"] if band["to"] - band["from"] > least))
        self.assertIn(f"narrower than {least:g} in Ω: ", text)

    def test_aperiodic_motions_are_not_safe_unless_asked_for(self):
        arguments = "--keep", "max_displacement<=30 mm", "--damping_ratio", "0.2", "--maps", self.folder / "maps.h5"
        shutil.copy(TINY / "maps.h5", self.folder / "maps.h5")
        with h5py.File(TINY / "atlas.h5") as atlas, h5py.File(self.folder / "maps.h5", "r+") as maps:
            line = 0, 0, 0, 2
            kept = (atlas["status"][line] == DONE) & (atlas["max_displacement"][line] <= 0.03)
            # So few revolutions make every irregular motion an unresolved one.
            maps["class"][line] = np.where(maps["class"][line] == 254, APERIODIC, maps["class"][line])
            periodic = maps["class"][line] != APERIODIC
        self.assertLess(in_bands(kept & periodic).sum(), in_bands(kept).sum())
        result, text = self.bands(*arguments)
        np.testing.assert_array_equal(self.speeds_in(result), in_bands(kept & periodic))
        self.assertIn("the motion is aperiodic at ", text)
        for more in (["--aperiodic"], ["--keep", "class<=255"]):
            np.testing.assert_array_equal(self.speeds_in(self.bands(*arguments, *more)[0]), in_bands(kept))
        self.assertIn("aperiodic motions are not left out", self.bands("--keep", "max_displacement<=30 mm")[1])

    def test_speeds_are_said_in_rpm_and_hz_and_read_in_them(self):
        arguments = "--keep", "max_displacement<=0.008", "--damping_ratio", "0.1", "--operate"
        plain, _ = self.bands(*arguments, "0.25")
        rpm, hertz = 0.25 * NATURAL_FREQUENCY * 30 / np.pi, 0.25 * NATURAL_FREQUENCY / (2 * np.pi)
        for speed in (f"{rpm} rpm", f"{hertz} Hz", "2.5 rad/s"):
            found, text = self.bands(*arguments, speed)
            self.assertAlmostEqual(found["operate"]["speed_ratio"], 0.25, places=12)
            self.assertAlmostEqual(found["operate"]["below_percent"], plain["operate"]["below_percent"], places=9)
            self.assertIn(f"At Ω 0.25 ({rpm:g} rpm, {hertz:g} Hz) every limit is kept in the sweep up; downwards", text)
        band = plain["bands"][0]
        self.assertAlmostEqual(band["to_rpm"], band["to"] * NATURAL_FREQUENCY * 30 / np.pi, places=9)
        self.assertAlmostEqual(band["from_hz"], band["from"] * NATURAL_FREQUENCY / (2 * np.pi), places=9)

    def test_the_picture_says_in_which_sweep_and_has_a_legend_and_an_axis_in_rpm(self):
        caught = []
        with unittest.mock.patch.object(style, "save", lambda figure, options: caught.append(figure)), \
                contextlib.redirect_stdout(io.StringIO()):
            safe_speeds.main(self.words("--operate", "24 rpm", "--keep", "max_displacement<=8 mm"))
        panel = caught[0].axes[0]
        self.assertIn("in the sweep up", panel.get_title(loc="left"))
        self.assertEqual([text.get_text() for text in panel.get_legend().get_texts()][:4],
                         ["every limit is kept\nin the sweep up", "the line nearest to the limit", "limit",
                          "operating speed Ω 0.251327\n(24 rpm, 0.4 Hz)"])
        self.assertEqual(panel.child_axes[0].get_xlabel(), "Speed [rpm]")

    def test_how_far_a_speed_is_from_danger_is_one_sentence(self):
        result, text = self.bands("--keep", "max_displacement<=0.008", "--damping_ratio", "0.1", "--operate", "0.25")
        band = next(band for band in result["bands"] if band["from"] <= 0.25 <= band["to"])
        said = result["operate"]["text"]
        self.assertEqual(said, text.splitlines()[-2])
        self.assertIn(f"upwards that holds for {100 * (band['to'] / 0.25 - 1):.1f} %, to Ω {band['to']:g} (beyond it "
                      f"not max_displacement ≤ 8 mm at {band['above']['speed_ratio']:g})", said)
        unsafe = (result["bands"][0]["to"] + 1e-3)
        result, _ = self.bands("--keep", "max_displacement<=0.008", "--damping_ratio", "0.1", "--operate", unsafe)
        self.assertRegex(result["operate"]["text"], r"the rotor is not safe in the sweep up: not max_displacement ≤ "
                         r"8 mm; the nearest safe speed is Ω .*, 0\.\d % lower\.$")

    def test_safe_is_said_of_the_sweep_and_the_other_one_is_looked_at_where_it_is_there(self):
        result, text = self.bands("--keep", "max_displacement<=0.008")
        self.assertEqual((result["said_of"], result["other_motions"]), ("the sweep up", []))
        self.assertIn('"sweep": "both" in the scene looks for it', text)
        basins, text = self.bands("--keep", "max_displacement<=12 mm", atlas=TINY / "basins.h5", drawn=True)
        self.assertEqual(basins["said_of"], "the motions from the initial states of the grid")
        self.assertNotIn("looks for it", text)

        scene = {"sweep": "both", "grid": {"speed_ratio": {"from": 0.62, "to": 0.7, "count": 17}},
                 "protocol": {"transient_revolutions": 60, "sampled_revolutions": 40, "samples_per_revolution": 64}}
        (self.folder / "both.json").write_text(json.dumps(scene))
        both, maps = self.folder / "both.h5", self.folder / "both_maps.h5"
        for command in (["run", self.folder / "both.json", "-o", both, "--progress", "off"],
                        ["analyse", both, "-o", maps]):
            subprocess.run([PROGRAM, *command], check=True, capture_output=True)
        with h5py.File(both) as file, h5py.File(maps, "r+") as mapped:
            # As if two calm motions were possible at the first three speeds, and at the next two an aperiodic one.
            mapped["attractor"][1, 0, 0, 0, 0, :5] = 77
            mapped["class"][1, 0, 0, 0, 0, 3:5] = APERIODIC
            kept = (file["max_displacement"][:, 0, 0, 0, 0] <= 0.012) & (mapped["class"][:, 0, 0, 0, 0] != APERIODIC)
            speed = file["speed_ratio"][...]
            up_alone = np.flatnonzero(kept[0] & ~kept[1])
            self.assertIn(3, up_alone)
            neighbours = np.split(up_alone, np.flatnonzero(np.diff(up_alone) > 1) + 1)
        limit = "--keep", "max_displacement<=12 mm"
        result, text = self.bands(*limit, atlas=both, drawn=True)
        self.assertEqual(result["said_of"], "both sweeps")
        self.assertEqual([(one["from"], one["to"], one["keeps_every_limit"]) for one in result["other_motions"]],
                         [(speed[0], speed[2], True)])
        self.assertIn("two motions are possible, both of which keep every limit", text)
        result, text = self.bands(*limit, "--direction", "up", atlas=both)
        self.assertEqual(result["said_of"], "the sweep up")
        self.assertEqual([(one["from"], one["to"], one["keeps_every_limit"]) for one in result["other_motions"]],
                         [(speed[0], speed[2], True), *((speed[one[0]], speed[one[-1]], False) for one in neighbours)])
        self.assertIn("the sweep down is not safe: the motion is aperiodic", text)
        self.assertNotIn("looks for it", text)
        result, text = self.bands("--keep", "max_displacement<=12 mm", "--aperiodic", "--direction", "down", atlas=both)
        self.assertIn("the sweep up has another motion, which keeps every limit", text)

    def test_a_run_up_is_judged_by_its_limits_alone(self):
        for name in ("atlas.h5", "maps.h5"):
            shutil.copy(TINY / name, self.folder / name)
        with h5py.File(self.folder / "maps.h5", "r+") as maps:
            maps["class"][...] = APERIODIC
        wanted = "--keep", "max_displacement<=50 mm", "--maps", self.folder / "maps.h5"
        self.assertEqual(self.bands(*wanted)[0]["bands"], [])
        for name in ("atlas.h5", "maps.h5"):
            with h5py.File(self.folder / name, "r+") as file:
                scene = json.loads(file["scene_resolved"][()])
                del file["scene_resolved"]
                file["scene_resolved"] = json.dumps({**scene, "speed_ramp": {"rate": 1e-4}})
        result, text = self.bands(*wanted, atlas=self.folder / "atlas.h5")
        self.assertIn("while the speed ramps no motion repeats itself", text)
        self.assertNotEqual(result["bands"], [])

    def test_the_same_bands_are_written_again_and_nothing_else_is_replaced(self):
        first, _ = self.bands("--keep", "max_displacement<=0.008")
        self.assertEqual(first, self.bands("--keep", "max_displacement<=0.008")[0])
        (self.folder / "safe.json").write_text('{"grid": 1}')
        code, _, _ = self.said("--keep", "max_displacement<=0.008", "--json", self.folder / "safe.json")
        self.assertEqual(code, 2)
        self.assertEqual((self.folder / "safe.json").read_text(), '{"grid": 1}')

    def test_a_mistake_is_one_sentence_and_exit_code_2(self):
        for arguments, words in ((["--keep", "max_displacement<0.008"], "not of the form"),
                                 (["--keep", "max_displacement<=wide"], "wide stands where a number is wanted"),
                                 (["--keep", "max_displacement<=3 N"], "what stands after it is a force"),
                                 (["--keep", "max_displacement<=3 inch"], "inch is no unit"),
                                 (["--keep", "max_displacement<=1", "--operate", "3 mm"], "after it is a length"),
                                 (["--keep", "max_displacement<=1", "--operate", "fast"], "where a number is wanted"),
                                 (["--keep", "displacement<=1"], "not in this file"),
                                 (["--keep", "poincare<=1"], "more than one number per point"),
                                 (["--keep", "class<=1"], "--maps"),
                                 (["--keep", "max_displacement<=1", "--operate", "3"], "outside the atlas"),
                                 (["--keep", "max_displacement<=1", "--json", "/nowhere/safe.json"], "folder")):
            code, _, errors = self.said(*arguments)
            self.assertEqual((code, errors.count("\n")), (2, 1), errors)
            self.assertIn(words, errors)


if __name__ == "__main__":
    unittest.main()
