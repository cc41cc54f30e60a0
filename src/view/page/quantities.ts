// What a body or a contact side can be coloured by: components, norms and units of the fields.

import type { Field, Grid } from "./grid";

export interface Quantity {
  label: string; // "temperature (K)"
  field: string;
  onCells: boolean;
  of(values: Field["values"], index: number): number;
}

const UNITS: Record<string, string> = {
  displacement: "m",
  velocity: "m/s",
  temperature: "K",
  stress: "Pa",
  von_mises: "Pa",
  gap: "m",
  pressure: "Pa",
  traction: "Pa",
  slip_velocity: "m/s",
  heat_flow: "W/m²",
  state: "0 open, 1 stick, 2 slip",
};

const VOIGT = ["xx", "yy", "zz", "xy", "yz", "xz"];

function quantitiesOf(fields: Map<string, Field>, onCells: boolean): Quantity[] {
  return [...fields].flatMap(([field, { components }]) => {
    const unit = UNITS[field] === undefined ? "" : ` (${UNITS[field]})`;
    const name = field.replaceAll("_", " ");
    const component = (i: number, what: string): Quantity => ({
      label: `${name}${what}${unit}`,
      field,
      onCells,
      of: (values, index) => values[index * components + i],
    });
    if (components === 1) {
      return [component(0, "")];
    }
    if (components === 6) {
      return VOIGT.map((what, i) => component(i, ` ${what}`));
    }
    const size: Quantity = {
      label: `|${name}|${unit}`,
      field,
      onCells,
      of: (values, index) => Math.hypot(values[3 * index], values[3 * index + 1], values[3 * index + 2]),
    };
    return [size, ...["x", "y", "z"].map((what, i) => component(i, ` ${what}`))];
  });
}

export function quantitiesIn(grid: Grid): Quantity[] {
  const cells = new Map([...grid.cellFields].filter(([name]) => name !== "boundary"));
  return [...quantitiesOf(grid.pointFields, false), ...quantitiesOf(cells, true)];
}

/** Values of all points, or of all cells. */
export function valuesOf(grid: Grid, quantity: Quantity): Float64Array {
  const field = (quantity.onCells ? grid.cellFields : grid.pointFields).get(quantity.field)!;
  const count = field.values.length / field.components;
  return Float64Array.from({ length: count }, (_, i) => quantity.of(field.values, i));
}

export interface Range {
  low: number;
  high: number;
}

export function rangeOf(parts: Iterable<Float64Array>): Range {
  const range = { low: Infinity, high: -Infinity };
  for (const values of parts) {
    for (const value of values) {
      range.low = Math.min(range.low, value);
      range.high = Math.max(range.high, value);
    }
  }
  return range.low <= range.high ? range : { low: 0, high: 0 };
}

export const shortText = (value: number) =>
  value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e5)
    ? value.toExponential(2)
    : Number(value.toPrecision(4)).toString();
