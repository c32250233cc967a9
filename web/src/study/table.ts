// Table of the page: the columns that the program wrote into it, as numbers where they have an order.

import { axisUnit } from "../units";

export interface Column {
    name: string;
    unit: string;
    about: string;
    kind: "float" | "integer" | "count" | "flag" | "text";
    /** As in the file: numbers, texts, flags; numbers that JSON lacks as text. */
    cells: (number | string | boolean)[];
    /** Values as numbers; a text has none. */
    values: number[];
}

export interface Record {
    arguments: string[];
    inputs: { path: string; sha256: string; text?: string }[];
}

export interface Manifest {
    version: string;
    spec_sha256: string;
    options: { [name: string]: string };
    record?: Record;
}

/** Meaning of the columns of the varied keys. */
const KEY = "varied key";
/** Numbers that JSON lacks. */
const SPECIAL: { [text: string]: number } = { NaN: Number.NaN, inf: Infinity, "-inf": -Infinity };

export class Table {
    readonly columns: Column[];
    readonly manifest: Manifest;

    constructor(text: string) {
        const data = JSON.parse(text);
        this.manifest = data.manifest;
        this.columns = data.columns.map((note: Column, k: number) => ({ ...note, cells: data.values[k], values: numbers(note, data.values[k]) }));
    }

    get rows(): number {
        return this.columns[0]?.cells.length ?? 0;
    }

    get keys(): Column[] {
        return this.columns.filter((column) => column.about === KEY);
    }

    /** Numbers that the study computed. */
    get quantities(): Column[] {
        return this.columns.filter((column) => column.about !== KEY && column.kind !== "text" && column.name !== "point");
    }

    find(name: string | null): Column | undefined {
        return this.columns.find((column) => column.name === name);
    }

    /** Points without a result. */
    get failures(): number {
        return this.find("failure")?.cells.filter((text) => text !== "").length ?? 0;
    }

    /** True for a point whose run has a period in which it had not settled. */
    isUnsettled(row: number): boolean {
        const periods = this.find("period_cycles")?.values[row] ?? 0;
        return periods > 0 && this.find("settled")?.values[row] === 0;
    }

    /** All rows as CSV: numbers are the shortest text that reads back to the same bits. */
    toCsv(): string {
        const quoted = (cell: number | string | boolean): string => {
            const text = Object.is(cell, -0) ? "-0.0" : String(cell);
            return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
        };
        const lines = [this.columns.map(({ name }) => quoted(name))];
        for (let row = 0; row < this.rows; row++) lines.push(this.columns.map(({ cells }) => quoted(cells[row])));
        return lines.map((line) => `${line.join(",")}\n`).join("");
    }
}

function numbers({ kind }: Column, cells: Column["cells"]): number[] {
    if (kind === "text") return [];
    return cells.map((cell) => (typeof cell === "string" ? SPECIAL[cell] ?? Number.NaN : Number(cell)));
}

/** Divisor and unit in which table and axis show a column. */
export function scale({ values, unit }: Column): [number, string] {
    return axisUnit(0, values.filter(Number.isFinite).reduce((most, value) => Math.max(most, Math.abs(value)), 0), unit);
}

/** Different values of a column, from the smallest. */
export function distinct({ values }: Column): number[] {
    return [...new Set(values.filter((value) => !Number.isNaN(value)))].sort((a, b) => a - b);
}
