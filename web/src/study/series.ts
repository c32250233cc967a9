// Curves of the chart: the points of the table that the filters admit, in groups of one colour.

import { quantity } from "../units";
import { type Column, type Table, distinct } from "./table";

/** Groups above this number become ranges of equally many points. */
const MAX_GROUPS = 8;
const RANGES = 5;

export interface View {
    x: Column;
    y: Column;
    group: Column | undefined;
    /** Value of a key at which the chart is cut. */
    fixed: Map<Column, number>;
}

export interface Series {
    words: string;
    /** Rows of the table, by the value on the horizontal axis. */
    rows: number[];
    /** True where the points are neighbours on a grid, which a line joins. */
    joined: boolean;
}

/** A value with its unit, a flag as words. */
export function words(column: Column, value: number, count = 4): string {
    if (column.kind === "flag") return value === 1 ? "yes" : "no";
    if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : value > 0 ? "∞" : "−∞";
    return quantity(value, column.unit, count);
}

export function series(table: Table, view: View): Series[] {
    const { x, y, group, fixed } = view;
    const drawn = (row: number) => Number.isFinite(x.values[row]) && Number.isFinite(y.values[row]);
    const admitted = (row: number) => [...fixed].every(([key, value]) => key.values[row] === value);
    const rows = Array.from({ length: table.rows }, (_, row) => row).filter((row) => drawn(row) && admitted(row));
    rows.sort((a, b) => x.values[a] - x.values[b] || a - b);
    const groups = group ? divide(group, rows) : [{ words: "", rows }];
    return groups.map((own) => ({ ...own, joined: isGrid(table, x, own.rows) }));
}

/** Points of one value of the group each, or of a range. */
function divide(group: Column, rows: number[]): { words: string; rows: number[] }[] {
    const values = distinct(group);
    const of = (words: string, take: (value: number) => boolean) => ({ words, rows: rows.filter((row) => take(group.values[row])) });
    const name = label(group);
    if (values.length <= MAX_GROUPS) return values.map((value) => of(`${name} ${words(group, value)}`, (own) => own === value)).filter(({ rows }) => rows.length > 0);
    const sorted = rows.map((row) => group.values[row]).filter(Number.isFinite).sort((a, b) => a - b);
    if (sorted.length === 0) return [];
    const ends = Array.from({ length: RANGES + 1 }, (_, k) => sorted[Math.min(Math.round((k * sorted.length) / RANGES), sorted.length - 1)]);
    return ends.slice(1).map((high, k) => {
        const [low, last] = [ends[k], k === RANGES - 1];
        return of(`${name} ${words(group, low, 3)} to ${words(group, high, 3)}`, (own) => own >= low && (own < high || (last && own <= high)));
    }).filter(({ rows }) => rows.length > 0);
}

/** True where each value of x has one point, and drawn points do not have values of their own. */
function isGrid(table: Table, x: Column, rows: number[]): boolean {
    const different = new Set(rows.map((row) => x.values[row])).size;
    return different === rows.length && (table.keys.length === 1 || distinct(x).length < table.rows);
}

/** Name of a column on an axis: keys by their path, numbers by their meaning. */
export function label({ name, about }: Column): string {
    return about === "varied key" || about === "" ? name : about;
}
