// Curves beside the body: along the contact side at one time, and a column of the history over time.

import uPlot from "uplot";

import type { Grid } from "./grid";
import { type Quantity, shortText, valuesOf } from "./quantities";

const ink = () => getComputedStyle(document.documentElement).getPropertyValue("--ink").trim();
const faint = () => getComputedStyle(document.documentElement).getPropertyValue("--line").trim();

export class Chart {
  private plot: uPlot | undefined;
  private labels = "";
  private time = 0;

  constructor(
    private readonly place: HTMLElement,
    private readonly markTime: boolean,
  ) {
    new ResizeObserver(() => this.plot?.setSize(this.size())).observe(place);
  }

  show(across: string, up: string, x: number[], y: (number | null)[], time: number): void {
    this.time = time;
    if (this.labels !== across + up) {
      this.plot?.destroy();
      this.plot = this.make(across, up, [x, y]);
      this.labels = across + up;
    } else {
      this.plot!.setData([x, y]);
    }
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(200, this.place.clientWidth), height: 210 };
  }

  private make(across: string, up: string, data: uPlot.AlignedData): uPlot {
    const axis = (label: string): uPlot.Axis => ({
      label,
      stroke: ink,
      grid: { stroke: faint },
      ticks: { stroke: faint },
      labelSize: 22,
      values: (_, ticks) => ticks.map(shortText),
    });
    const mark = (plot: uPlot) => {
      const x = plot.valToPos(this.time, "x", true);
      plot.ctx.strokeStyle = ink();
      plot.ctx.strokeRect(x, plot.bbox.top, 0, plot.bbox.height);
    };
    return new uPlot(
      {
        ...this.size(),
        scales: { x: { time: false } },
        axes: [axis(across), { ...axis(up), size: 70 }],
        series: [{ label: across }, { label: up, stroke: "#2a788e", width: 2 }],
        legend: { show: false },
        hooks: this.markTime ? { draw: [mark] } : {},
      },
      data,
      this.place,
    );
  }
}

/** A quantity along a side in the plane: arc length of the undeformed side, m, with gaps (null) where it is interrupted. */
export function along(grid: Grid, quantity: Quantity, side: number): { x: number[]; y: (number | null)[] } {
  const values = valuesOf(grid, quantity);
  const sides = grid.cellFields.get("boundary")!.values;
  const n = grid.nodesPerCell;
  const order = n === 3 ? [0, 2, 1] : [0, 1]; // VTK has the middle of a curved edge last
  const pieces = Array.from({ length: sides.length }, (_, cell) => order.map((i) => grid.connectivity[cell * n + i]))
    .filter((_, cell) => sides[cell] === side)
    .map((nodes) => (grid.points[3 * nodes[0]] <= grid.points[3 * nodes[nodes.length - 1]] ? nodes : [...nodes].reverse()));
  const at = (node: number, i: number) => grid.points[3 * node + i];
  pieces.sort((a, b) => at(a[0], 0) - at(b[0], 0) || at(a[0], 1) - at(b[0], 1));
  const x: number[] = [];
  const y: (number | null)[] = [];
  let length = 0;
  let last: number | undefined;
  for (const node of pieces.flat()) {
    length += last === undefined ? 0 : Math.hypot(at(node, 0) - at(last, 0), at(node, 1) - at(last, 1));
    x.push(length);
    y.push(values[node]);
    last = node;
  }
  return { x, y };
}
