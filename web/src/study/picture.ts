// Chart of the study, with the point under the mouse or chosen by the arrow keys.

import type { Axis } from "../axis";
import { Chart, around } from "../chart";
import type { Curve, Mark } from "../paint";
import { colour, shade } from "../theme";
import { Zoom } from "../zoom";
import { type Series, type View, label, words } from "./series";
import { type Column, scale } from "./table";

/** Distance at which a point is found, CSS pixels. */
const CATCH = 40;
const DOT = 2.6;
/** Radius of the ring around a point that had not settled. */
const RING = 5;
/** Share of the horizontal axis beyond the points. */
const ROOM = 0.01;
/** Ends of the axis of a flag, 0 or 1. */
const FLAG: [number, number] = [-0.06, 1.06];

export class Picture {
    readonly chart: Chart;
    private series: Series[] = [];
    private view: View | undefined;
    private logs: [boolean, boolean] = [false, false];
    private at: [number, number] | undefined;
    /** Called with the row of a point, or with nothing; `chosen` by a click or a key. */
    onPoint: (row: number | undefined, chosen: boolean) => void = () => {};

    constructor(private readonly host: HTMLElement, private readonly isUnsettled: (row: number) => boolean) {
        this.chart = new Chart(host);
        const zoom = new Zoom(this.chart);
        host.addEventListener("pointermove", (event) => this.point(event, false));
        host.addEventListener("pointerleave", () => this.choose(undefined, false));
        host.addEventListener("click", (event) => !zoom.dragged && this.point(event, true));
        host.addEventListener("keydown", (event) => this.key(event));
    }

    show(view: View, series: Series[], logs: [boolean, boolean]): void {
        [this.view, this.series, this.logs] = [view, series, logs];
        this.choose(undefined, false);
        this.draw();
    }

    draw(): void {
        if (!this.view) return;
        const { x, y } = this.view;
        const axis = (column: Column, log: boolean): Axis => {
            const flag = column.kind === "flag" && !log;
            return { words: label(column), unit: column.unit, log, scale: scale(column), flag, ends: flag ? FLAG : undefined };
        };
        const curves = this.series.flatMap((own, k) => this.curves(own, k));
        const [over, up] = [axis(x, this.logs[0]), axis(y, this.logs[1])];
        this.chart.show({ ...over, ends: over.ends ?? this.ends(curves) }, up, curves, this.rings);
        this.host.setAttribute("aria-label", `${label(y)} over ${label(x)}; the arrow keys select a point`);
    }

    /** Ends of the horizontal axis: points at the ends are drawn completely. */
    private ends(curves: Curve[]): [number, number] | undefined {
        const [log] = this.logs;
        const values = curves.flatMap(({ x }) => Array.from(x, (value) => (log ? Math.log(value) : value)));
        if (values.length === 0) return undefined;
        const [low, high] = values.reduce(([least, most], value) => [Math.min(least, value), Math.max(most, value)], [Infinity, -Infinity]);
        if (low === high && !log) return around(low);
        const room = low === high ? Math.LN2 : ROOM * (high - low);
        return log ? [Math.exp(low - room), Math.exp(high + room)] : [low - room, high + room];
    }

    /** Rows of a curve that its axes can show. */
    private drawn({ rows }: Series): number[] {
        const { x, y } = this.view!;
        return rows.filter((row) => (!this.logs[0] || x.values[row] > 0) && (!this.logs[1] || y.values[row] > 0));
    }

    /** Rings around the points that had not settled. */
    private get rings(): Mark[] {
        const { x, y } = this.view!;
        const rows = this.series.flatMap((own) => this.drawn(own)).filter(this.isUnsettled);
        return rows.map((row) => ({ x: x.values[row], y: y.values[row], colour: colour("ink"), shape: "ring", size: RING }));
    }

    private curves(own: Series, index: number): Curve[] {
        const { joined } = own;
        const { x, y } = this.view!;
        const drawn = this.drawn(own);
        const curve = { x: drawn.map((row) => x.values[row]), y: drawn.map((row) => y.values[row]), colour: shade(index) };
        return joined ? [curve, { ...curve, dots: DOT }] : [{ ...curve, dots: DOT }];
    }

    /** The nearest point to the mouse. */
    private point(event: MouseEvent, chosen: boolean): void {
        const box = this.chart.over?.getBoundingClientRect();
        if (!box || !this.view) return;
        const [x, y] = [event.clientX - box.left, event.clientY - box.top];
        let [least, found]: [number, [number, number] | undefined] = [CATCH, undefined];
        this.series.forEach(({ rows }, k) => rows.forEach((row, place) => {
            const [px, py] = this.chart.place(this.view!.x.values[row], this.view!.y.values[row]);
            const far = Math.hypot(px - x, py - y);
            if (far < least) [least, found] = [far, [k, place]];
        }));
        this.choose(found, chosen);
    }

    /** Left and right follow a curve, up and down change it. */
    private key(event: KeyboardEvent): void {
        const step = ({ ArrowRight: [0, 1], ArrowLeft: [0, -1], ArrowUp: [-1, 0], ArrowDown: [1, 0] } as Record<string, [number, number]>)[event.key];
        if (!step || event.shiftKey || this.series.length === 0) return;
        event.preventDefault();
        const [k, place] = this.at ?? [0, -step[1]];
        const next = Math.min(Math.max(k + step[0], 0), this.series.length - 1);
        const last = this.series[next].rows.length - 1;
        if (last >= 0) this.choose([next, Math.min(Math.max(place + step[1], 0), last)], true);
    }

    private choose(at: [number, number] | undefined, chosen: boolean): void {
        this.at = at;
        const row = at && this.series[at[0]].rows[at[1]];
        if (row === undefined) this.chart.cursor();
        else this.chart.cursor([this.view!.x.values[row], this.view!.y.values[row]]);
        this.onPoint(row, chosen);
    }

    /** The curves with their colours, and the ring of points that had not settled, below the chart. */
    legend(list: HTMLElement): void {
        list.replaceChildren(...this.series.filter(({ words }) => words).map((own, k) => {
            const item = document.createElement("li");
            item.style.setProperty("--own", shade(k));
            item.textContent = own.words;
            return item;
        }));
        if (this.rings.length === 0) return;
        const item = document.createElement("li");
        item.className = "unsettled";
        item.textContent = "not settled";
        list.append(item);
    }
}

/** Sentence about a point: its number, its keys, the quantity. */
export function pointWords(columns: View["x"][], row: number): string {
    return columns.map((column) => `${label(column)} ${words(column, column.values[row])}`).join(", ");
}
