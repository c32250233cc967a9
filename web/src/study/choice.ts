// What the chart shows: both columns, the group, values of the other keys, logarithmic axes. The address keeps it.

import { type View, label, words } from "./series";
import { type Column, type Table, distinct } from "./table";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

/** Keys with more values are drawn, not stepped: no value is chosen. */
const MAX_VALUES = 100;
/** Ratio of the largest to the smallest value of a key above which its axis is logarithmic. */
const WIDE = 30;

export class Choice {
    private readonly x = find<HTMLSelectElement>("x");
    private readonly y = find<HTMLSelectElement>("y");
    private readonly group = find<HTMLSelectElement>("group");
    private readonly logs = [find<HTMLInputElement>("log-x"), find<HTMLInputElement>("log-y")];
    private readonly others = find("others");
    /** Values of the keys, also of those that are on an axis now. */
    private readonly fixed = new Map<string, string>();
    onChange: () => void = () => {};

    constructor(private readonly table: Table) {
        const { keys, quantities } = table;
        const option = (column: Column) => new Option(label(column), column.name);
        this.y.replaceChildren(...quantities.map(option), ...keys.map(option));
        this.x.replaceChildren(...keys.map(option), ...quantities.map(option));
        this.group.replaceChildren(new Option("nothing", ""), ...keys.map(option), ...quantities.map(option));
        const first = new URLSearchParams(location.hash.slice(1));
        const set = (select: HTMLSelectElement, name: string, otherwise: string) => {
            select.value = table.find(first.get(name)) ? first.get(name)! : otherwise;
        };
        set(this.y, "y", quantities[0]?.name ?? "");
        // The key with the most values, of several the first.
        const [over] = [...keys].sort((a, b) => distinct(b).length - distinct(a).length);
        set(this.x, "x", over?.name ?? "");
        set(this.group, "group", keys.find(({ name }) => name !== this.x.value)?.name ?? "");
        if (first.get("group") === "") this.group.value = "";
        this.logs[0].checked = first.has("x") ? first.has("log-x") : isWide(table.find(this.x.value));
        this.logs[1].checked = first.has("log-y");
        for (const text of first.getAll("at")) this.fixed.set(text.slice(0, text.indexOf("=")), text.slice(text.indexOf("=") + 1));
        this.x.onchange = () => {
            this.logs[0].checked = isWide(table.find(this.x.value));
            this.changed();
        };
        for (const field of [this.y, this.group, ...this.logs]) field.onchange = () => this.changed();
        this.offer();
    }

    get view(): View {
        const { table } = this;
        const fixed = new Map(this.rest.flatMap((key): [Column, number][] => {
            const value = this.fixed.get(key.name);
            return value ? [[key, Number(value)]] : [];
        }));
        return { x: table.find(this.x.value)!, y: table.find(this.y.value)!, group: table.find(this.group.value), fixed };
    }

    get isLog(): [boolean, boolean] {
        return [this.logs[0].checked, this.logs[1].checked];
    }

    /** Keys that neither axis nor group shows, with a few values each. */
    private get rest(): Column[] {
        const shown = [this.x.value, this.y.value, this.group.value];
        return this.table.keys.filter((key) => !shown.includes(key.name) && distinct(key).length <= Math.min(MAX_VALUES, this.table.rows - 1));
    }

    /** Offers a value of each other key: at first the smallest. */
    private offer(): void {
        this.others.replaceChildren(...this.rest.map((key) => {
            const select = document.createElement("select");
            select.setAttribute("aria-label", key.name);
            const values = distinct(key);
            select.replaceChildren(new Option("all values", ""), ...values.map((value) => new Option(words(key, value, 5), String(value))));
            const wanted = this.fixed.get(key.name);
            select.value = wanted === "" || values.some((value) => String(value) === wanted) ? wanted! : String(values[0]);
            this.fixed.set(key.name, select.value);
            select.onchange = () => {
                this.fixed.set(key.name, select.value);
                this.changed();
            };
            const field = document.createElement("label");
            field.append(`${key.name} `, select);
            return field;
        }));
    }

    private changed(): void {
        this.offer();
        const shown = new URLSearchParams({ x: this.x.value, y: this.y.value, group: this.group.value });
        if (this.logs[0].checked) shown.set("log-x", "");
        if (this.logs[1].checked) shown.set("log-y", "");
        for (const key of this.rest) shown.append("at", `${key.name}=${this.fixed.get(key.name)}`);
        history.replaceState(null, "", `#${shown}`);
        this.onChange();
    }
}

function isWide(column: Column | undefined): boolean {
    const values = column ? distinct(column).filter(Number.isFinite) : [];
    return values.length > 2 && values[0] > 0 && values[values.length - 1] / values[0] > WIDE;
}
