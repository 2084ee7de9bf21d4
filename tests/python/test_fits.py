"""Fits to measured data."""

import json
import math
import unittest

import vehd
from helpers import SOURCE, InFolder


class Fits(InFolder):
    def test_a_fit_is_that_of_the_program(self):
        scene = str(SOURCE / "docs/fits/charging_scene.toml")
        # Without noise: capacitance and conductance of the scene.
        rows = []
        for i in range(0, 26, 5):
            pair = 2 * 6e-4 * 4.5e-4 / (6e-4 + 9e-4)
            leak = pair / 1e-5 + 5.0
            value = 750.0 * pair / 1e-5 / leak * (1.0 - math.exp(-4e-5 * i * leak / 0.008))
            rows.append(f"{0.04 * i},{value},10")
        data = self.write("time [ms],Vm_north [mV],deviation [mV]\n" + "\n".join(rows), "data.csv")
        fit = {"experiment": [{"scene": scene, "data": str(data), "quantity": "Vm_north"}],
               "free": {"membrane.capacitance": {"from": "0.3 uF/cm^2", "to": "3 uF/cm^2"}}}
        result = vehd.fit(fit, self.folder / "python", plot=False)
        self.assertAlmostEqual(result["values"]["membrane.capacitance"], 0.8, delta=0.004)
        text = (f"[[experiment]]\nscene = {json.dumps(scene)}\ndata = {json.dumps(str(data))}\n"
                "quantity = \"Vm_north\"\n[free]\n"
                "\"membrane.capacitance\" = {from = \"0.3 uF/cm^2\", to = \"3 uF/cm^2\"}\n")
        self.run_program("fit", self.write(text, "fit.toml"), "-o", self.folder / "program", "--no-plot", "--quiet")
        self.assertEqual(json.loads((self.folder / "program/fit.json").read_text()), result)

    def test_mistakes_have_the_words_of_the_program(self):
        with self.assertRaisesRegex(vehd.InputError, r"no table \[\[experiment\]\]"):
            vehd.fit({"free": {}}, self.folder / "out")
        with self.assertRaisesRegex(vehd.InputError, "no such file"):
            vehd.fit("none.toml", self.folder / "out")
        with self.assertRaisesRegex(vehd.InputError, "jobs is 0"):
            vehd.fit("none.toml", self.folder / "out", jobs=0)


if __name__ == "__main__":
    unittest.main()
