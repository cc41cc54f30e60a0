// A results folder, embedded in the page: each file is the text of a <script data-file="NAME"> element.

import { type Grid, readGrid } from "./grid";

export interface Results {
  title: string;
  status: string;
  contactNames: string[]; // by the number in the contact grid's cell field `boundary`
  times: number[];
  size: number; // characters of all files
  body(index: number): Grid;
  contact(index: number): Grid | undefined;
  history: Map<string, number[]>; // columns of history.csv
}

function embedded(file: string): string {
  const element = document.querySelector(`script[data-file="${CSS.escape(file)}"]`);
  if (element === null) {
    throw new Error(`${file} is not part of this page`);
  }
  return element.textContent ?? "";
}

function columnsOf(csv: string): Map<string, number[]> {
  const [header, ...rows] = csv.trim().split("\n");
  const columns = header.split(",").map((name): [string, number[]] => [name, []]);
  for (const row of rows) {
    row.split(",").forEach((value, i) => columns[i]?.[1].push(Number(value)));
  }
  return new Map(columns);
}

function remembered(load: (index: number) => Grid): (index: number) => Grid {
  const known = new Map<number, Grid>();
  return (index) => {
    const grid = known.get(index) ?? load(index);
    known.set(index, grid);
    return grid;
  };
}

export function readResults(): Results {
  const files = new Map<number, string[]>(); // by time: body, contact
  const collection = new DOMParser().parseFromString(embedded("fields.pvd"), "text/xml");
  for (const entry of collection.querySelectorAll("DataSet")) {
    const time = Number(entry.getAttribute("timestep"));
    const parts = files.get(time) ?? [];
    parts[Number(entry.getAttribute("part"))] = entry.getAttribute("file") ?? "";
    files.set(time, parts);
  }
  const times = [...files.keys()].sort((a, b) => a - b);
  const summary = JSON.parse(embedded("summary.json"));
  const grid = (part: number) => remembered((index) => readGrid(files.get(times[index])![part], embedded));
  const contact = grid(1);
  return {
    title: summary.scene?.title || "thermocontact",
    status: summary.status,
    contactNames: Object.keys(summary.final?.contact ?? {}),
    times,
    size: [...document.querySelectorAll("script[data-file]")].reduce((sum, file) => sum + file.textContent!.length, 0),
    body: grid(0),
    contact: (index) => (files.get(times[index])![1] === undefined ? undefined : contact(index)),
    history: columnsOf(embedded("history.csv")),
  };
}
