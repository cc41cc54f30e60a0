// The page of one run. Its state is in the address (#time=8&of=temperature (K)), and in data-... of <html> for tests.

import { along, Chart } from "./charts";
import { gradient } from "./colours";
import type { Grid } from "./grid";
import { type Quantity, quantitiesIn, type Range, rangeOf, shortText, valuesOf } from "./quantities";
import { readResults, type Results } from "./results";
import { Stage } from "./stage";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const FRAME = 80; // ms between steps that play
const READ_AT_ONCE = 40_000_000; // characters of fields that are read in a moment

const offer = (select: HTMLSelectElement, names: string[]) =>
  select.replaceChildren(...names.map((name) => new Option(name)));

class Page {
  private readonly time = find<HTMLInputElement>("time");
  private readonly shown = find<HTMLSelectElement>("shown");
  private readonly of = find<HTMLSelectElement>("of");
  private readonly scale = find<HTMLInputElement>("scale");
  private readonly allTimes = find<HTMLInputElement>("all-times");
  private readonly side = find<HTMLSelectElement>("side");
  private readonly contactOf = find<HTMLSelectElement>("contact-of");
  private readonly column = find<HTMLSelectElement>("column");
  private readonly inSpace: boolean;
  private readonly bodyQuantities: Quantity[];
  private readonly contactQuantities: Quantity[];
  private readonly stage: Stage;
  private readonly contactChart = new Chart(find("contact-chart"), false);
  private readonly historyChart = new Chart(find("history-chart"), true);
  private readonly ranges = new Map<string, Range>();
  private playing: number | undefined;

  constructor(private readonly results: Results) {
    const grid = results.body(0);
    this.inSpace = grid.points.some((x, i) => i % 3 === 2 && x !== 0);
    this.bodyQuantities = quantitiesIn(grid);
    const contact = results.contact(0);
    this.contactQuantities = contact === undefined ? [] : quantitiesIn(contact);
    this.stage = new Stage(find<HTMLCanvasElement>("stage"), this.inSpace);
    this.fill();
    this.listen();
    const { length } = results.times; // it may move far
    const some = [0, Math.floor(length / 2), length - 1].map((index) => this.moved(results.body(index)));
    this.stage.lookAt(some, this.inSpace);
    this.show();
  }

  private fill(): void {
    const { results } = this;
    document.title = `${results.title} · thermocontact`;
    find("title").textContent = results.title;
    find("status").textContent = results.status === "completed" ? "" : results.status;
    find("bar").style.background = gradient();
    this.allTimes.checked = results.size < READ_AT_ONCE;
    this.time.max = String(results.times.length - 1);
    this.offerQuantities();
    offer(this.side, results.contactNames);
    offer(this.contactOf, this.contactQuantities.map(({ label }) => label));
    offer(this.column, [...results.history.keys()].filter((name) => name !== "time" && name !== "step"));
    find("contact").hidden = this.inSpace || this.contactQuantities.length === 0;
    find("show").hidden = !this.inSpace || this.contactQuantities.length === 0;
    find("deformation").hidden = !results.body(0).pointFields.has("displacement");
    this.contactOf.value = this.contactQuantities.find(({ field }) => field === "pressure")?.label ?? this.contactOf.value;
    this.column.value = "contact_fraction";
    this.readAddress();
  }

  private readAddress(): void {
    const wanted = new URLSearchParams(decodeURIComponent(location.hash.slice(1)));
    this.of.value = this.quantities.some(({ label }) => label === wanted.get("of")) ? wanted.get("of")! : this.of.value;
    this.time.value = wanted.get("time") ?? this.time.max;
  }

  /** What is coloured: the body, or in space its contact sides, which are drawn where they lie undeformed. */
  private get showsContact(): boolean {
    return this.shown.value === "contact";
  }

  private get quantities(): Quantity[] {
    return this.showsContact ? this.contactQuantities : this.bodyQuantities;
  }

  private grid(index: number): Grid {
    return this.showsContact ? this.results.contact(index)! : this.results.body(index);
  }

  private offerQuantities(): void {
    offer(this.of, this.quantities.map(({ label }) => label));
    const usual = this.showsContact ? "pressure" : "temperature";
    this.of.value = this.quantities.find(({ field }) => field === usual)?.label ?? this.of.value;
  }

  private listen(): void {
    const change = () => this.show();
    for (const input of [this.time, this.of, this.scale, this.allTimes, this.side, this.contactOf, this.column]) {
      input.addEventListener("input", change);
    }
    this.shown.addEventListener("input", () => {
      this.offerQuantities();
      this.show();
    });
    const lines = find<HTMLInputElement>("lines");
    lines.addEventListener("input", () => this.stage.showLines(lines.checked));
    find("play").addEventListener("click", () => this.play());
    find("reset").addEventListener("click", () => this.stage.lookAt([this.moved(this.grid(Number(this.time.value)))], this.inSpace));
  }

  private play(): void {
    clearInterval(this.playing);
    const button = find("play");
    if (button.getAttribute("aria-pressed") === "true") {
      button.setAttribute("aria-pressed", "false");
      return;
    }
    button.setAttribute("aria-pressed", "true");
    this.playing = window.setInterval(() => {
      this.time.value = String((Number(this.time.value) + 1) % this.results.times.length);
      this.show();
    }, FRAME);
  }

  private range(quantity: Quantity, values: Float64Array): Range {
    if (!this.allTimes.checked) {
      return rangeOf([values]);
    }
    const name = `${this.shown.value} ${quantity.label}`;
    const known = this.ranges.get(name);
    const all = known ?? rangeOf(this.results.times.map((_, i) => valuesOf(this.grid(i), quantity)));
    this.ranges.set(name, all);
    return all;
  }

  private moved(grid: Grid): Float64Array {
    const displacement = grid.pointFields.get("displacement")?.values;
    const factor = Number(this.scale.value);
    return displacement === undefined ? grid.points : grid.points.map((x, i) => x + factor * displacement[i]);
  }

  private show(): void {
    const index = Number(this.time.value);
    const time = this.results.times[index];
    const grid = this.grid(index);
    const quantity = this.quantities[this.of.selectedIndex];
    const values = valuesOf(grid, quantity);
    const range = this.range(quantity, values);
    this.stage.show(grid, this.moved(grid), values, quantity.onCells, range);
    find("time-text").textContent = `t = ${shortText(time)} s`;
    find("scale-text").textContent = `${this.scale.value} ×`;
    find("low").textContent = shortText(range.low);
    find("middle").textContent = shortText(0.5 * (range.low + range.high));
    find("high").textContent = shortText(range.high);
    find("of-text").textContent = quantity.label;
    this.showCurves(index, time);
    const shown = rangeOf([values]);
    Object.assign(document.documentElement.dataset, {
      state: "ready",
      time: String(time),
      low: String(shown.low),
      high: String(shown.high),
      triangles: String(this.stage.triangles),
    });
    history.replaceState(null, "", `#time=${index}&of=${encodeURIComponent(quantity.label)}`);
  }

  private showCurves(index: number, time: number): void {
    const contact = this.results.contact(index);
    if (contact !== undefined && !this.inSpace && this.contactQuantities.length > 0) {
      const quantity = this.contactQuantities[this.contactOf.selectedIndex];
      const { x, y } = along(contact, quantity, this.side.selectedIndex);
      this.contactChart.show("along the side (m)", quantity.label, x, y, time);
    }
    const { history } = this.results;
    const column = this.column.value;
    if (history.has(column)) {
      this.historyChart.show("t (s)", column.replaceAll("_", " "), history.get("time")!, history.get(column)!, time);
    }
  }
}

function fail(reason: unknown): void {
  document.documentElement.dataset.state = `failed: ${reason}`;
  find("status").textContent = `This page cannot be shown: ${reason}`;
}

window.addEventListener("error", (event) => fail(event.message));
try {
  new Page(readResults());
} catch (error) {
  fail(error);
}
