// What is seen of a grid: in the plane all cells, in space the faces that belong to one cell alone, cut into triangles.

import type { Grid } from "./grid";

export interface Surface {
  points: Int32Array; // [triangles][3], points of the grid
  cells: Int32Array; // [triangles], the cell of each
  edges: Int32Array; // [edges][2], points of the grid
}

interface Face {
  corners: number[]; // what makes it the same face as a neighbour's
  triangles: number[][];
  outline: number[]; // closed
}

const triangle = (a: number, b: number, c: number): Face => ({
  corners: [a, b, c],
  triangles: [[a, b, c]],
  outline: [a, b, c],
});

/** ab, bc, ca: the nodes at the middle of the sides. */
const triangle6 = (a: number, b: number, c: number, ab: number, bc: number, ca: number): Face => ({
  corners: [a, b, c],
  triangles: [
    [a, ab, ca],
    [ab, b, bc],
    [ca, bc, c],
    [ab, bc, ca],
  ],
  outline: [a, ab, b, bc, c, ca],
});

const square = (a: number, b: number, c: number, d: number): Face => ({
  corners: [a, b, c, d],
  triangles: [
    [a, b, c],
    [a, c, d],
  ],
  outline: [a, b, c, d],
});

const square9 = (corners: number[], middles: number[], centre: number): Face => {
  const outline = corners.flatMap((corner, i) => [corner, middles[i]]);
  return {
    corners,
    triangles: outline.map((node, i) => [centre, node, outline[(i + 1) % outline.length]]),
    outline,
  };
};

/** Faces of VTK's cells, by type; those of a plane cell are itself. */
const facesOf: Record<number, Face[]> = {
  5: [triangle(0, 1, 2)],
  22: [triangle6(0, 1, 2, 3, 4, 5)],
  9: [square(0, 1, 2, 3)],
  28: [square9([0, 1, 2, 3], [4, 5, 6, 7], 8)],
  10: [triangle(0, 2, 1), triangle(0, 1, 3), triangle(1, 2, 3), triangle(2, 0, 3)],
  24: [
    triangle6(0, 2, 1, 6, 5, 4),
    triangle6(0, 1, 3, 4, 8, 7),
    triangle6(1, 2, 3, 5, 9, 8),
    triangle6(2, 0, 3, 6, 7, 9),
  ],
  12: [
    square(0, 4, 7, 3),
    square(1, 2, 6, 5),
    square(0, 1, 5, 4),
    square(3, 7, 6, 2),
    square(0, 3, 2, 1),
    square(4, 5, 6, 7),
  ],
  29: [
    square9([0, 4, 7, 3], [16, 15, 19, 11], 20),
    square9([1, 2, 6, 5], [9, 18, 13, 17], 21),
    square9([0, 1, 5, 4], [8, 17, 12, 16], 22),
    square9([3, 7, 6, 2], [19, 14, 18, 10], 23),
    square9([0, 3, 2, 1], [11, 10, 9, 8], 24),
    square9([4, 5, 6, 7], [12, 13, 14, 15], 25),
  ],
};

const isPlane = (cellType: number) => facesOf[cellType].length === 1;

/** Points at one place have one number: pieces of a parallel run double those on their borders. */
function placesOf(points: Float64Array): Int32Array {
  const known = new Map<string, number>();
  return Int32Array.from({ length: points.length / 3 }, (_, i) => {
    const key = `${points[3 * i]},${points[3 * i + 1]},${points[3 * i + 2]}`;
    const place = known.get(key) ?? i;
    known.set(key, place);
    return place;
  });
}

export function surfaceOf(grid: Grid): Surface {
  const faces = facesOf[grid.cellType];
  if (faces === undefined) {
    throw new Error(`cells of VTK type ${grid.cellType} are not known`);
  }
  const places = placesOf(grid.points);
  const seen = new Map<string, { cell: number; face: Face } | null>(); // null: met twice, inside the body
  for (let cell = 0; cell < grid.connectivity.length / grid.nodesPerCell; ++cell) {
    const node = (i: number) => grid.connectivity[cell * grid.nodesPerCell + i];
    faces.forEach((face) => {
      const corners = face.corners.map((i) => places[node(i)]).sort((a, b) => a - b);
      const key = isPlane(grid.cellType) ? String(cell) : corners.join(",");
      seen.set(key, seen.has(key) ? null : { cell, face });
    });
  }
  const points: number[] = [];
  const cells: number[] = [];
  const edges = new Map<string, [number, number]>();
  for (const entry of seen.values()) {
    if (entry === null) {
      continue;
    }
    const node = (i: number) => grid.connectivity[entry.cell * grid.nodesPerCell + i];
    for (const corners of entry.face.triangles) {
      points.push(...corners.map(node));
      cells.push(entry.cell);
    }
    const outline = entry.face.outline.map(node);
    outline.forEach((a, i) => {
      const b = outline[(i + 1) % outline.length];
      const [low, high] = [places[a], places[b]].sort((x, y) => x - y);
      edges.set(`${low},${high}`, [a, b]);
    });
  }
  return {
    points: Int32Array.from(points),
    cells: Int32Array.from(cells),
    edges: Int32Array.from([...edges.values()].flat()),
  };
}
