"""compare.py must notice what differs and overlook what may differ: numbering, round-off, ties of the contact state.

Run from verification/: python3 -m unittest tests.test_compare
"""

import contextlib
import io
import json
import shutil
import tempfile
import unittest
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

import compare
from oracle_parts import vtu

EPSILON = 1e-3
Change = Callable[[dict[tuple[int, int], vtu.Grid], dict[str, Any]], None]

PieceChange = Callable[[list[vtu.Grid]], None]


def grids() -> dict[tuple[int, int], vtu.Grid]:
    """By (step, part): two triangles, and two contact facets that meet in (1, 0)."""
    result = {}
    for step in (0, 1):
        points = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]])
        body_data = {"temperature": np.array([1.0, 2.0, 3.0, 4.0]) * (step + 1), "displacement": points * 0.1}
        cell_data = {"von_mises": np.array([5.0, 6.0])}
        cells = np.array([[0, 1, 3], [1, 2, 3]])
        result[step, 0] = vtu.Grid(points, cells, vtu.TRIANGLE, body_data, cell_data)
        slip = np.zeros((4, 3))
        slip[:, 0] = [2 * EPSILON, 0.0, 3 * EPSILON, EPSILON]
        contact_data = {
            "gap": np.array([-1e-4, 0.0, -2e-4, -3e-4]),
            "slip_velocity": slip,
            "state": np.array([2, 1, 2, 1], dtype=np.int32),
        }
        marks = {"boundary": np.zeros(2, dtype=np.int32)}
        facets = np.array([[0, 1], [2, 3]])
        result[step, 1] = vtu.Grid(points[[0, 1, 1, 2]], facets, vtu.LINE, contact_data, marks)
    return result


def summary() -> dict[str, Any]:
    friction = {"coefficient": 0.2, "regularisation": EPSILON}
    return {
        "status": "completed",
        "scene": {"boundary": {"top": {}, "bottom": {"contact": {"friction": friction}}}},
        "final": {"velocity_l2": 2.0, "contact": {"bottom": {"normal_force": 1.0, "slip_fraction": 0.5}}},
    }


def write(directory: Path, change: Change | None = None, times: tuple[float, ...] = (0.0, 0.5)) -> None:
    data, numbers = grids(), summary()
    if change:
        change(data, numbers)
    (directory / "fields").mkdir(parents=True)
    datasets = []
    for (step, part), grid in data.items():
        name = f"fields/{compare.PARTS[part]}_{step:06d}.vtu"
        vtu.write_grid(directory / name, grid)
        datasets.append(vtu.DataSet(times[step], part, name))
    vtu.write_collection(directory / "fields.pvd", datasets)
    (directory / "summary.json").write_text(json.dumps(numbers))


def into_pieces(directory: Path, step: int, part: int, change: PieceChange | None = None) -> None:
    """Replaces a grid by a PVTU of three pieces: the cells one by one, and a process without any."""
    collection = directory / "fields.pvd"
    grid = grids()[step, part]
    pieces: list[vtu.Grid] = []
    for cells in (grid.cells[:1], grid.cells[1:], grid.cells[:0]):
        nodes, local = np.unique(cells, return_inverse=True)
        rows = slice(0, 1) if len(pieces) == 0 else slice(1, 2) if len(pieces) == 1 else slice(0, 0)
        pieces.append(
            vtu.Grid(
                grid.points[nodes],
                local.reshape(cells.shape),
                grid.cell_type,
                {name: values[nodes] for name, values in grid.point_data.items()},
                {name: values[rows] for name, values in grid.cell_data.items()},
            )
        )
    if change:
        change(pieces)
    stem = f"{compare.PARTS[part]}_{step:06d}"
    for number, piece in enumerate(pieces):
        vtu.write_grid(directory / f"fields/{stem}_p{number}.vtu", piece)
    fields = [f'<PDataArray type="Float64" Name="{name}"/>' for name in grid.point_data]
    of_cells = [f'<PDataArray type="Float64" Name="{name}"/>' for name in grid.cell_data]
    sources = [f'<Piece Source="{stem}_p{number}.vtu"/>' for number in range(len(pieces))]
    (directory / f"fields/{stem}.pvtu").write_text(
        f'<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid><PPointData>{"".join(fields)}</PPointData>'
        f'<PCellData>{"".join(of_cells)}</PCellData>{"".join(sources)}</PUnstructuredGrid></VTKFile>'
    )
    (directory / f"fields/{stem}.vtu").unlink()
    collection.write_text(collection.read_text().replace(f"{stem}.vtu", f"{stem}.pvtu"))


def point_change(part: int, name: str, at: Any, by: float, step: int = 1) -> Change:
    def change(data: dict[tuple[int, int], vtu.Grid], numbers: dict[str, Any]) -> None:
        values = data[step, part].point_data[name].copy()
        values[at] += by
        fields = {**data[step, part].point_data, name: values}
        data[step, part] = replace(data[step, part], point_data=fields)

    return change


class CompareTest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.a, self.b = Path(folder.name) / "a", Path(folder.name) / "b"
        write(self.a)

    def code(self, *options: str) -> int:
        self.output = io.StringIO()
        with contextlib.redirect_stdout(self.output), contextlib.redirect_stderr(self.output):
            return compare.main([str(self.a), str(self.b), *options])

    def code_after(self, change: Change) -> int:
        write(self.b, change)
        return self.code()

    def test_equal(self) -> None:
        write(self.b)
        self.assertEqual(self.code(), 0)

    def test_numbering_does_not_matter(self) -> None:
        def renumber(data: dict[tuple[int, int], vtu.Grid], numbers: dict[str, Any]) -> None:
            for key, grid in data.items():
                new = np.array([2, 0, 3, 1])  # new number of each point
                old, cells = np.argsort(new), np.array([1, 0])
                data[key] = vtu.Grid(
                    grid.points[old],
                    new[grid.cells[cells]],
                    grid.cell_type,
                    {name: values[old] for name, values in grid.point_data.items()},
                    {name: values[cells] for name, values in grid.cell_data.items()},
                )

        self.assertEqual(self.code_after(renumber), 0, "renumbered")

    def test_point_values(self) -> None:
        self.assertEqual(self.code_after(point_change(0, "temperature", 3, 8.1e-9)), 1)
        self.assertIn("the worst is body temperature at t = 0.5, (1, 1, 0): 1.01", self.output.getvalue())

    def test_point_values_below_the_tolerance(self) -> None:
        self.assertEqual(self.code_after(point_change(0, "temperature", 3, 7.9e-9)), 0)
        self.assertEqual(self.code("--tolerance", "1e-10"), 1)

    def test_scale_is_over_all_steps(self) -> None:
        self.assertEqual(self.code_after(point_change(0, "temperature", 0, 7.9e-9, step=0)), 0)

    def test_the_side_of_a_shared_contact_point(self) -> None:
        self.assertEqual(self.code_after(point_change(1, "gap", 2, 1e-10)), 1)

    def test_cell_values(self) -> None:
        def change(data: dict[tuple[int, int], vtu.Grid], numbers: dict[str, Any]) -> None:
            data[0, 0] = replace(data[0, 0], cell_data={"von_mises": np.array([5.0, 6.0 + 1e-7])})

        self.assertEqual(self.code_after(change), 1)

    def test_not_finite(self) -> None:
        self.assertEqual(self.code_after(point_change(0, "temperature", 1, np.nan)), 1)

    def test_not_finite_in_both(self) -> None:
        change = point_change(1, "gap", 1, np.inf)
        write(self.b, change)
        self.a = self.a.parent / "c"
        write(self.a, change)
        self.assertEqual(self.code(), 1)

    def test_state_differs(self) -> None:
        self.assertEqual(self.code_after(point_change(1, "state", 0, -1)), 1)

    def test_state_of_a_tie_in_gap(self) -> None:
        self.assertEqual(self.code_after(point_change(1, "state", 1, -1)), 0)

    def test_state_of_a_tie_in_slip(self) -> None:
        self.assertEqual(self.code_after(point_change(1, "state", 3, 1)), 0)

    def test_final_numbers(self) -> None:
        def change(data: dict[tuple[int, int], vtu.Grid], numbers: dict[str, Any]) -> None:
            numbers["final"]["contact"]["bottom"]["slip_fraction"] = 0.5 + 2e-9

        self.assertEqual(self.code_after(change), 1)

    def code_at_rest(self, difference: float, velocities: Sequence[float]) -> int:
        """Velocities that end at 1e-7 and differ by so much, after these; no history without any."""
        for folder, final in ((self.a, 1e-7), (self.b, 1e-7 + difference)):

            def change(
                _: dict[tuple[int, int], vtu.Grid], numbers: dict[str, Any], final: float = final
            ) -> None:
                numbers["final"]["velocity_l2"] = final

            shutil.rmtree(folder, ignore_errors=True)
            write(folder, change)
            if velocities:
                rows = "".join(f"{velocity}\n" for velocity in velocities)
                (folder / "history.csv").write_text("velocity_l2\n" + rows, encoding="ascii")
        return self.code()

    def test_velocity_at_rest_is_known_to_round_off_of_the_displacement(self) -> None:
        """Two runs of 100 steps at up to 3 m/s: 2 * 100 * 3 * 2^-53 = 6.7e-14 m/s; and 1e-9 * 1e-7 beside it."""
        far = [3.0] * 50 + [1e-7] * 50
        self.assertEqual(self.code_at_rest(6e-14, far), 0)
        self.assertEqual(self.code_at_rest(7e-14, far), 1)
        self.assertEqual(self.code_at_rest(1e-15, [1e-7] * 100), 1, "nothing has moved far")
        self.assertEqual(self.code_at_rest(1e-15, []), 1, "no history")
        self.assertEqual(self.code_at_rest(0.0, far), 0)

    def test_field_in_one_only(self) -> None:
        def change(data: dict[tuple[int, int], vtu.Grid], numbers: dict[str, Any]) -> None:
            data[1, 0] = replace(data[1, 0], cell_data={})

        self.assertEqual(self.code_after(change), 2)

    def test_contact_in_one_only(self) -> None:
        def change(data: dict[tuple[int, int], vtu.Grid], numbers: dict[str, Any]) -> None:
            del data[1, 1]

        self.assertEqual(self.code_after(change), 2)

    def code_of_steps(self, other: str) -> int:
        """Beside equal results, these steps in one folder, and in the other one that was rejected and one taken."""
        rows = "1,0.5,0.5,0.1,velocity,rejected\n1,0.25,0.25,1e-3,velocity,accepted\n"
        for folder, text in ((self.a, rows), (self.b, other)):
            (folder / "steps.csv").write_text(
                "step,time,size,error_estimate,field,outcome\n" + text, encoding="ascii"
            )
        return self.code()

    def test_adaptive_steps(self) -> None:
        """What the estimate is in its last digits does not matter."""
        write(self.b)
        rows = "1,0.5,0.5,0.1000001,velocity,rejected\n1,0.25,0.25,1e-3,velocity,accepted\n"
        self.assertEqual(self.code_of_steps(rows), 0)
        self.assertEqual(self.code_of_steps(rows.replace("rejected", "failed")), 2)
        self.assertEqual(self.code_of_steps(rows.replace("0.25,0.25", "0.125,0.125")), 2)
        self.assertEqual(self.code_of_steps(rows + "1,0.5,0.25,1e-3,velocity,accepted\n"), 2)
        self.assertIn("other adaptive steps from number 3 on", self.output.getvalue())

    def code_of_pieces(self, part: int, change: PieceChange | None = None) -> int:
        write(self.b)
        into_pieces(self.b, 1, part, change)
        return self.code()

    def test_pieces_are_one_grid(self) -> None:
        self.assertEqual(self.code_of_pieces(0), 0)

    def test_pieces_of_the_contact_keep_their_points(self) -> None:
        self.assertEqual(self.code_of_pieces(1), 0)

    def test_a_value_in_one_piece(self) -> None:
        def change(pieces: list[vtu.Grid]) -> None:
            pieces[1].point_data["temperature"][1] += 1e-7  # of the point at (2, 0)

        self.assertEqual(self.code_of_pieces(0, change), 1)

    def test_a_seam_that_does_not_fit(self) -> None:
        def change(pieces: list[vtu.Grid]) -> None:
            pieces[1].point_data["temperature"][0] += 1e-14  # of the shared (1, 0)

        self.assertEqual(self.code_of_pieces(0, change), 2)
        self.assertIn("temperature at [1.0, 0.0, 0.0] is not the same in all pieces", self.output.getvalue())

    def test_a_cell_that_two_pieces_have(self) -> None:
        def change(pieces: list[vtu.Grid]) -> None:
            pieces[2] = pieces[0]

        self.assertEqual(self.code_of_pieces(0, change), 2)

    def test_a_field_that_one_piece_lacks(self) -> None:
        def change(pieces: list[vtu.Grid]) -> None:
            pieces[0] = replace(pieces[0], cell_data={})

        self.assertEqual(self.code_of_pieces(0, change), 2)

    def test_a_piece_that_is_missing(self) -> None:
        write(self.b)
        into_pieces(self.b, 1, 0)
        (self.b / "fields/body_000001_p1.vtu").unlink()
        self.assertEqual(self.code(), 2)

    def test_other_mesh(self) -> None:
        def change(data: dict[tuple[int, int], vtu.Grid], numbers: dict[str, Any]) -> None:
            points = data[1, 0].points.copy()
            points[3, 1] += 1e-6
            data[1, 0] = replace(data[1, 0], points=points)

        self.assertEqual(self.code_after(change), 2)

    def test_other_times(self) -> None:
        write(self.b, times=(0.0, 0.6))
        self.assertEqual(self.code(), 2)

    def test_missing_files(self) -> None:
        self.assertEqual(self.code(), 2)
        write(self.b)
        (self.b / "fields/body_000001.vtu").unlink()
        self.assertEqual(self.code(), 2)

    def test_damaged_file(self) -> None:
        write(self.b)
        path = self.b / "fields/body_000001.vtu"
        path.write_text(path.read_text()[:-200])
        self.assertEqual(self.code(), 2)


if __name__ == "__main__":
    unittest.main()
