"""The oracle against solutions known by hand, all within its element's space: only round-off may remain.

Run from verification/: python3 -m unittest tests.test_oracle
"""

import json
import math
import tempfile
import unittest
from pathlib import Path
from typing import Any

import oracle
from oracle_parts import vtu

MESH = 'mesh = {lower = [0.0, 0.0], upper = [2.0, 0.5], cells = [4, 3], diagonal = "crossed"}'


class OracleTest(unittest.TestCase):
    def solve(self, scene: str) -> dict[str, Any]:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        path = self.folder / "scene.toml"
        path.write_text(MESH + scene, encoding="utf-8")
        code = oracle.main([str(path), "--output", str(self.folder), "--quiet"])
        self.assertEqual(code, 0)
        final: dict[str, Any] = json.loads((self.folder / "summary.json").read_text())["final"]
        return final

    def grid(self, name: str) -> vtu.Grid:
        return vtu.read_grid(self.folder / f"fields/{name}.vtu")

    def test_slab_between_lid_and_foundation(self) -> None:
        """Stationary heat through K/H and k_c in series; theta is linear over the height."""
        final = self.solve(
            """
            time = {end = 1.0, steps = 1}
            heat = {conductivity = 3.0}
            boundary.top.temperature = 10.0
            boundary.bottom.contact.gap = -1.0
            boundary.bottom.contact.conductance = {coefficient = 4.0, onset = 0.1, foundation_temperature = 2.0}
            """
        )
        flux = (10.0 - 2.0) / (0.5 / 3.0 + 1 / 4.0)
        self.assertAlmostEqual(final["contact"]["bottom"]["heat_flow"], 2.0 * flux, delta=1e-12)
        body = self.grid("body_000001")
        for point, theta in zip(body.points, body.point_data["temperature"]):
            self.assertAlmostEqual(theta, 10.0 - flux / 3.0 * (0.5 - point[1]), delta=1e-12)

    def test_compressed_block_on_a_foundation(self) -> None:
        """Uniaxial stress -1: strain -1/E along y, nu/E along x; penetration 1/c_n."""
        final = self.solve(
            """
            time = {end = 1.0, steps = 1}
            material.elasticity = {young = 8.0, poisson = 0.25}
            boundary.left.displacement = [0.0, "free"]
            boundary.top.traction = [0.0, -1.0]
            boundary.bottom.contact.compliance = {stiffness = 100.0}
            """
        )
        strain_norm = math.hypot(1 / 8.0, 0.25 / 8.0)  # the area is 1
        self.assertAlmostEqual(final["displacement_strain_l2"], strain_norm, delta=1e-13)
        self.assertAlmostEqual(final["contact"]["bottom"]["normal_force"], 2.0, delta=1e-12)
        self.assertAlmostEqual(final["contact"]["bottom"]["max_penetration"], 0.01, delta=1e-14)
        for stress in self.grid("body_000001").cell_data["stress"]:
            for value, exact in zip(stress, (0.0, -1.0, 0.0, 0.0, 0.0, 0.0)):
                self.assertAlmostEqual(value, exact, delta=1e-12)

    def test_confined_block_that_is_heated(self) -> None:
        """Plane strain, no strain at all: stress -theta M in all three normal directions."""
        self.solve(
            """
            time = {end = 1.0, steps = 2}
            material.elasticity = {young = 8.0, poisson = 0.25, plane = "strain"}
            material.density = 1.0
            heat = {capacity = 1.0, source = 6.0, thermal_stress = 0.5}
            boundary.left.displacement = [0.0, 0.0]
            boundary.right.displacement = [0.0, 0.0]
            boundary.top.displacement = [0.0, 0.0]
            boundary.bottom.displacement = [0.0, 0.0]
            """
        )
        for stress in self.grid("body_000002").cell_data["stress"]:
            for value, exact in zip(stress, (-3.0, -3.0, -3.0, 0.0, 0.0, 0.0)):
                self.assertAlmostEqual(value, exact, delta=1e-12)

    def test_free_fall(self) -> None:
        """Backward Euler: w_n = -t_n and u_n = -k^2 n (n + 1)/2."""
        final = self.solve(
            """
            time = {end = 1.0, steps = 10}
            material = {density = 2.0, viscosity = {trace = 1.0, shear = 1.0}}
            load.body_force = [0.0, -2.0]
            """
        )
        self.assertAlmostEqual(final["velocity_l2"], 1.0, delta=1e-12)
        for displacement in self.grid("body_000010").point_data["displacement"]:
            self.assertAlmostEqual(displacement[1], -0.55, delta=1e-12)

    def test_follows_adaptive_steps(self) -> None:
        """theta = t whatever the steps, and nothing but steps that fill the scene's is taken."""
        scene = "time = {end = 1.0, steps = 2, tolerance = 1e-3}\nheat = {capacity = 1.0, source = 1.0}\n"
        whole = "1,0.5,0.5,0,,trial\n1,0.125,0.125,0,,accepted\n1,0.5,0.375,0,,beyond-tolerance\n2,1,0.5,0,,accepted\n"
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "scene.toml"
            path.write_text(MESH + "\n" + scene, encoding="utf-8")
            for rows, code in (
                (whole, 0),
                (whole.replace("beyond-tolerance", "rejected"), 2),
                (whole.replace("0.5,0.375", "0.5,0.25"), 2),
                (whole[: whole.index("2,1")], 2),
            ):
                rows = "step,time,size,error_estimate,field,outcome\n" + rows
                (Path(folder) / "steps.csv").write_text(rows, encoding="ascii")
                command = [str(path), "--output", folder, "--follow", folder, "--quiet"]
                self.assertEqual(oracle.main(command), code, rows)
            self.assertEqual(oracle.main([str(path), "--output", folder, "--quiet"]), 2)

    def test_dragged_block(self) -> None:
        """A block moved along the foundation at speed v: friction mu p_n v/|v|_eps on the whole side."""
        final = self.solve(
            """
            time = {end = 1.0, steps = 4}
            material.elasticity = {young = 8.0, poisson = 0.25}
            boundary.top.displacement = ["0.3*t", -0.01]
            boundary.left.displacement = ["0.3*t", -0.01]
            boundary.right.displacement = ["0.3*t", -0.01]
            boundary.bottom.displacement = ["0.3*t", "free"]
            boundary.bottom.contact.compliance = {stiffness = 1e-3, exponent = 2.0}
            boundary.bottom.contact.friction = {coefficient = 0.5, regularisation = 0.4}
            """
        )
        bottom = final["contact"]["bottom"]
        ratio = bottom["tangential_force"] / bottom["normal_force"]
        self.assertAlmostEqual(ratio, 0.5 * 0.3 / 0.5, delta=1e-12)
        self.assertEqual(bottom["slip_fraction"], 0.0)
        self.assertAlmostEqual(bottom["contact_fraction"], 1.0, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
