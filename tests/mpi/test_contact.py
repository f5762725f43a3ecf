"""Where blades touch the ring, as an atlas says it that keeps no figure of contacts, against one that does."""
import unittest

import h5py
import numpy as np

from job import JobTest

NOT_KNOWN, NONE, CONTACT = 0, 1, 2
# Free motion, some of it beside motion with contact: an unbalance at its resonance, a load against the ring, a start
# from which the vibration takes long to die out. What touches at the speed below leave dies out in the transient.
ROTORS = {
    "unbalance": {"rotor": {"misalignment": 0.005, "damping_ratio": 0.05}, "unbalance": {"moment": 6e-4}},
    "many_blades": {"rotor": {"misalignment": 0.004, "damping_ratio": 0.05}, "blades": {"count": 7},
                    "unbalance": {"moment": 7e-4, "phase": 1.0}},
    "load": {"rotor": {"misalignment": 0.008}, "side_load": {"force": 0.15, "direction": 1.2},
             "unbalance": {"moment": 2e-4}},
    "slow": {"rotor": {"misalignment": 0.009, "damping_ratio": 1e-3}, "initial": {"x": 2e-3}},
    "default": {},
}
DIED_OUT = ("unbalance", "load")  # rotors whose free vibration has died out where they are closest to contact


class Contact(JobTest):
    def contacts(self, name, rotor, observables):
        scene = {"title": name, "reference": "none", "grid": {"speed_ratio": {"from": 0.2, "to": 1.9, "count": 35}},
                 "protocol": {"transient_revolutions": 60, "sampled_revolutions": 36, "samples_per_revolution": 64},
                 "observables": ["poincare", "max_displacement", *observables], **rotor}
        atlas = self.fill(None, scene, f"{name}.h5")
        job = self.execute(None, "analyse", atlas, "-o", f"{name}_maps.h5")
        self.assertEqual((job.returncode, job.stderr), (0, ""))
        return atlas, self.directory / f"{name}_maps.h5", " ".join(job.stdout.split())

    def test_sections_tell_what_the_share_of_time_in_contact_tells(self):
        seen = set()
        for name, rotor in ROTORS.items():
            with self.subTest(rotor=name):
                atlas, kept, told = self.contacts(name, rotor, ["contact_fraction", "nearest_miss"])
                _, derived, said = self.contacts(f"{name}_sections", rotor, [])
                with h5py.File(atlas) as file, h5py.File(kept) as maps, h5py.File(derived) as others:
                    done = file["status"][...] == 1
                    contact = maps["contact"][...]
                    np.testing.assert_array_equal(contact[done], np.where(file["contact_fraction"][...] > 0.0, CONTACT,
                                                                          NONE)[done])
                    np.testing.assert_array_equal(contact[~done], NOT_KNOWN)
                    np.testing.assert_array_equal(others["contact"][...], contact)
                    seen |= set(contact[done])
                    near, far = (one["table1/closest_distance"][0] for one in (maps, others))
                    sentence = maps["table1/contact"][0].decode()
                    if (contact == NONE).any():
                        # A lower bound where vibration is left, after contact at the speed below or undamped.
                        left = 1e-7 if name in DIED_OUT else np.inf
                        self.assertTrue(near - left < far < near + 1e-7)
                    if not (contact[done] == CONTACT).all():
                        self.assertIn(f"CONTACT {sentence}.", told)
                        self.assertIn("CONTACT ", said)
        self.assertEqual(seen, {NONE, CONTACT})

    def test_a_rotor_that_never_touches_has_no_regions(self):
        never = {"rotor": {"misalignment": 0.005, "damping_ratio": 0.05}, "unbalance": {"moment": 4e-4}}
        _, path, text = self.contacts("never", never, [])
        self.assertRegex(text, r"CONTACT no contact; closest 1\.\d+ mm at Ω = 1\.")
        with h5py.File(path) as maps:
            for region in range(1, 5):
                self.assertNotEqual(maps[f"table1/region_{region}_presence"][0], 2)
            self.assertTrue(np.isnan(maps["table1/first_contact"][0]))

    def test_a_rotor_that_touches_from_some_speed_on_says_which(self):
        atlas, path, text = self.contacts("some", ROTORS["unbalance"], ["contact_fraction"])
        with h5py.File(atlas) as file, h5py.File(path) as maps:
            touching = file["contact_fraction"][0, 0, 0, 0] > 0.0
            first = file["speed_ratio"][...][touching][0]
            self.assertEqual(maps["table1/first_contact"][0], first)
            self.assertRegex(maps["table1/contact"][0].decode(), "^(first contact|contact) at Ω = ")
        self.assertIn(f"at Ω = {first:g}", text)


if __name__ == "__main__":
    unittest.main()
