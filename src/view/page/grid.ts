// VTK's XML grids as the driver writes them (src/output/vtu.cpp): inline binary, a UInt64 count of bytes first.

export interface Field {
  components: number;
  values: Float64Array | Int32Array;
}

export interface Grid {
  points: Float64Array; // [n][3], m
  cellType: number; // VTK's; one kind a grid
  nodesPerCell: number;
  connectivity: Int32Array; // [cells][nodesPerCell]
  pointFields: Map<string, Field>;
  cellFields: Map<string, Field>;
}

function bytesOf(text: string): ArrayBuffer {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) {
    bytes[i] = binary.charCodeAt(i);
  }
  return bytes.buffer.slice(8);
}

function numbersOf(array: Element): Float64Array | Int32Array {
  const bytes = bytesOf(array.textContent ?? "");
  const type = array.getAttribute("type");
  switch (type) {
    case "Float64":
      return new Float64Array(bytes);
    case "Int32":
      return new Int32Array(bytes);
    case "Int64":
      return Int32Array.from(new BigInt64Array(bytes), Number);
    case "UInt8":
      return Int32Array.from(new Uint8Array(bytes));
    default:
      throw new Error(`unknown type of numbers: ${type}`);
  }
}

function arraysIn(piece: Element, section: string): Map<string, Field> {
  const fields = new Map<string, Field>();
  for (const array of piece.querySelectorAll(`${section} > DataArray`)) {
    fields.set(array.getAttribute("Name") ?? "", {
      components: Number(array.getAttribute("NumberOfComponents") ?? 1),
      values: numbersOf(array),
    });
  }
  return fields;
}

function parsePiece(text: string): Grid {
  const piece = new DOMParser().parseFromString(text, "text/xml").querySelector("Piece");
  if (piece === null) {
    throw new Error("a file of fields has no piece: it is damaged");
  }
  const cells = arraysIn(piece, "Cells");
  const types = cells.get("types")!.values;
  const connectivity = cells.get("connectivity")!.values as Int32Array;
  return {
    points: arraysIn(piece, "Points").get("Points")!.values as Float64Array,
    cellType: types.length > 0 ? types[0] : 0,
    nodesPerCell: types.length > 0 ? connectivity.length / types.length : 1,
    connectivity,
    pointFields: arraysIn(piece, "PointData"),
    cellFields: arraysIn(piece, "CellData"),
  };
}

function joinedNumbers<T extends Float64Array | Int32Array>(parts: T[]): T {
  const length = parts.reduce((sum, part) => sum + part.length, 0);
  const result = new (parts[0].constructor as new (n: number) => T)(length);
  let at = 0;
  for (const part of parts) {
    result.set(part, at);
    at += part.length;
  }
  return result;
}

function joinedFields(parts: Map<string, Field>[]): Map<string, Field> {
  const result = new Map<string, Field>();
  for (const [name, field] of parts[0]) {
    const values = joinedNumbers(parts.map((part) => part.get(name)!.values as Float64Array));
    result.set(name, { components: field.components, values });
  }
  return result;
}

/** The pieces of a parallel run as one grid; points on their borders stay doubled. */
function joined(pieces: Grid[]): Grid {
  const filled = pieces.filter((piece) => piece.connectivity.length > 0);
  if (filled.length < 2) {
    return filled[0] ?? pieces[0];
  }
  let first = 0;
  const connectivities = filled.map((piece) => {
    const shifted = piece.connectivity.map((node) => node + first);
    first += piece.points.length / 3;
    return shifted;
  });
  return {
    points: joinedNumbers(filled.map((piece) => piece.points)),
    cellType: filled[0].cellType,
    nodesPerCell: filled[0].nodesPerCell,
    connectivity: joinedNumbers(connectivities),
    pointFields: joinedFields(filled.map((piece) => piece.pointFields)),
    cellFields: joinedFields(filled.map((piece) => piece.cellFields)),
  };
}

/** The grid in a .vtu or .pvtu; `read` returns the text of a file named relative to the folder of `fields.pvd`. */
export function readGrid(file: string, read: (file: string) => string): Grid {
  const text = read(file);
  if (!file.endsWith(".pvtu")) {
    return parsePiece(text);
  }
  const folder = file.slice(0, file.lastIndexOf("/") + 1);
  const pieces = new DOMParser().parseFromString(text, "text/xml").querySelectorAll("Piece");
  return joined([...pieces].map((piece) => parsePiece(read(folder + piece.getAttribute("Source")))));
}
