// Chart of curves on axes: uPlot draws axes, grid and scales.

import uPlot from "uplot";
import { AROUND, type Axis, ChartAxis, type Range, axisScale } from "./axis";
import { mirror } from "./mirror";
import { type Nearest, nearestPoint } from "./nearest";
import { apart, type Curve, type Mark, type Rule, unitCircle, drawCurve, drawMark, drawRule, drawWords } from "./paint";
import type { Drawn } from "./print";
import { record } from "./recorder";

/** Smallest width of a magnified axis, relative to its values: the labels of its lines differ. */
const NARROWEST = 1e-4;

interface Size {
    width: number;
    height: number;
}

/** Sizes of charts in a print, CSS pixels. The width of a large one is the geometric mean of the text on A4 and on A5, to which it is scaled; two small ones are next to each other. */
const PRINTED = { large: { width: 574, height: 320 }, small: { width: 280, height: 180 } };

export class Chart implements Drawn {
    /** All charts of the page. */
    static readonly all: Chart[] = [];
    private plot: uPlot | undefined;
    private shape = "";
    private curves: Curve[] = [];
    private marks: Mark[] = [];
    private rules: Rule[] = [];
    private x: Axis = { words: "", unit: "" };
    private y: Axis = { words: "", unit: "" };
    private ends: [Range, Range] = [[0, 1], [0, 1]];
    /** Ends of all that is shown, and of the part that is magnified. */
    private full: [Range, Range] = [[0, 1], [0, 1]];
    private part: [Range, Range] | undefined;
    private axes: ChartAxis[] = [];
    private readonly pointers: HTMLElement[] = [];
    /** Called when another part is magnified; `byUser` is false where another range or quantity ends it. */
    onZoom: (byUser: boolean) => void = () => {};
    private round = false;
    /** Words in place of curves that are not computed yet. */
    waiting = "";
    /** Draws more, in device pixels. */
    extra: ((plot: uPlot) => void) | undefined;

    constructor(readonly host: HTMLElement, private readonly compact = false) {
        host.setAttribute("role", "img");
        new ResizeObserver(() => this.resize()).observe(host);
        Chart.all.push(this);
    }

    show(x: Axis, y: Axis, curves: Curve[], marks: Mark[] = [], rules: Rule[] = [], round = false): void {
        const before = JSON.stringify([this.x, this.y.words, this.y.log]);
        [this.x, this.y, this.curves, this.marks, this.rules, this.round] = [x, y, curves, marks, rules, round];
        // Another range or quantity is shown complete.
        if (this.part && before !== JSON.stringify([x, y.words, y.log])) this.magnify(undefined, false);
        this.full = [drawable(x.ends ?? this.span("x", x), x.log), drawable(y.ends ?? this.span("y", { ...y, room: true }), y.log)];
        this.ends = this.part ?? this.full;
        const shape = JSON.stringify([x.words, x.log, y.words, y.log, document.documentElement.dataset.theme, axisScale(x, this.ends[0]), axisScale(y, this.ends[1]), this.isEmpty]);
        if (!this.plot || shape !== this.shape) {
            this.shape = shape;
            this.build();
        } else {
            this.plot.setData(this.dummy());
        }
    }

    /** True without a value on the vertical axis: its ends are then not of the data, so it has no numbers. */
    private get isEmpty(): boolean {
        return this.y.ends === undefined && !this.curves.some(({ y }) => Array.prototype.some.call(y, Number.isFinite));
    }

    private dummy(): uPlot.AlignedData {
        return [this.ends[0], this.ends[1]];
    }

    redraw(): void {
        if (this.curves.length + this.marks.length > 0) this.show(this.x, this.y, this.curves, this.marks, this.rules, this.round);
    }

    get isZoomed(): boolean {
        return this.part !== undefined;
    }

    /** Ends of the visible part of the horizontal axis. */
    get visible(): Range {
        return this.ends[0];
    }

    /** Magnifies about a point, in shares of width and height from below left; a factor below 1 shows less. */
    zoom(share: [number, number], factor: number): void {
        this.look((low, high, k) => {
            const centre = low + share[k] * (high - low);
            return [centre - factor * (centre - low), centre + factor * (high - centre)];
        });
    }

    /** Moves the visible part by shares of its width and height. */
    pan(share: [number, number]): void {
        if (this.part) this.look((low, high, k) => [low + share[k] * (high - low), high + share[k] * (high - low)]);
    }

    unzoom(): void {
        this.magnify(undefined);
        this.redraw();
    }

    /** Ends of both axes where a part is magnified. */
    get visiblePart(): [Range, Range] | undefined {
        return this.part;
    }

    /** Magnifies a part, from its ends on both axes; returns false where the chart does not have it. */
    showPart(ends: number[]): boolean {
        const part: [Range, Range] = [[ends[0], ends[1]], [ends[2], ends[3]]];
        const isInside = part.every(([low, high], k) => low < high && low < this.full[k][1] && high > this.full[k][0] && (low > 0 || ![this.x, this.y][k].log));
        if (!isInside) return false;
        this.magnify(part);
        this.redraw();
        return true;
    }

    private magnify(part: [Range, Range] | undefined, byUser = true): void {
        this.part = part;
        this.onZoom(byUser);
    }

    /** Changes the visible part, inside all that is shown. */
    private look(change: (low: number, high: number, axis: 0 | 1) => Range): void {
        const next = ([0, 1] as const).map((k): Range => {
            const { log } = [this.x, this.y][k];
            const on = (value: number) => (log ? Math.log(value) : value);
            const off = (value: number) => (log ? Math.exp(value) : value);
            const [first, last] = this.full[k].map(on);
            const [low, high] = change(on(this.ends[k][0]), on(this.ends[k][1]), k);
            const width = Math.min(high - low, last - first);
            const start = Math.min(Math.max(low, first), last - width);
            const ends: Range = [off(start), off(start + width)];
            return ends[1] - ends[0] > NARROWEST * Math.max(Math.abs(ends[0]), Math.abs(ends[1])) ? ends : this.ends[k];
        }) as [Range, Range];
        const isFull = next.every((range, k) => range.every((end, side) => Math.abs(end - this.full[k][side]) <= 1e-9 * Math.abs(this.full[k][1] - this.full[k][0])));
        this.magnify(isFull ? undefined : next);
        this.redraw();
    }

    /** Places the cursors: a vertical line at a value, or a dot at a point. Without values none is shown. */
    cursor(...at: [x: number, y?: number][]): void {
        const { plot, pointers } = this;
        while (pointers.length < at.length) pointers.push(document.createElement("div"));
        pointers.forEach((pointer, k) => {
            pointer.hidden = !plot || k >= at.length;
            if (!plot || k >= at.length) return;
            const [x, y] = at[k];
            if (pointer.parentElement !== plot.over) plot.over.append(pointer);
            pointer.className = y === undefined ? "cursor" : "cursor dot";
            pointer.style.transform = `translate(${plot.valToPos(x, "x")}px, ${y === undefined ? 0 : plot.valToPos(y, "y")}px)`;
        });
    }

    /** The curve that passes nearest to a position of the pointer, and its point there. */
    nearest({ clientX, clientY }: MouseEvent): Nearest | undefined {
        const box = this.over?.getBoundingClientRect();
        if (!box) return undefined;
        const drawn = this.curves.map(({ x, y, gap }) => ({ count: x.length, place: (point: number) => this.place(x[point], y[point]), gap }));
        return nearestPoint([clientX - box.left, clientY - box.top], drawn);
    }

    /** Position of a point in CSS pixels of the plotting area. */
    place(x: number, y: number): [number, number] {
        if (!this.plot) return [Number.NaN, Number.NaN];
        return [this.plot.valToPos(x, "x"), this.plot.valToPos(y, "y")];
    }

    /** Value on the horizontal axis at a position in CSS pixels of the plotting area. */
    valueAt(x: number): number {
        return this.plot?.posToVal(x, "x") ?? Number.NaN;
    }

    /** The area over the curves, for the mouse. */
    get over(): HTMLElement | undefined {
        return this.plot?.over;
    }

    get canvas(): HTMLCanvasElement | undefined {
        return this.plot?.ctx.canvas;
    }

    /** Points of all curves, in the units of `titles`. */
    get points(): [number, number][] {
        return this.curves.flatMap(({ x, y }) => Array.from(x, (value, k): [number, number] => [value, y[k]]));
    }

    /** Words and SI units of both axes. */
    get titles(): string[] {
        return [this.x, this.y].map(({ words, unit }) => (unit ? `${words} (${unit})` : words));
    }

    /** The chart as an SVG document, on `paper` if it is given. */
    svg(paper?: string): string | undefined {
        const { plot } = this;
        // A batch draws before it returns.
        return plot && record(plot.ctx, () => plot.batch(() => plot.redraw(false)), paper);
    }

    /** The chart as an SVG document for a print: letters do not depend on the size of the window. */
    printed(): string | undefined {
        this.setSize(PRINTED[this.compact ? "small" : "large"]);
        const svg = this.svg();
        this.resize();
        return svg;
    }

    /** Draws the chart on another canvas, larger by a factor, and so far below its upper end. */
    drawOn(target: CanvasRenderingContext2D, factor: number, top: number): void {
        const { plot } = this;
        if (plot) mirror(plot.ctx, () => plot.batch(() => plot.redraw(false)), target, factor, top);
    }

    private span(which: "x" | "y", { log, room: hasRoom, holds }: Axis): Range {
        let [low, high] = [Infinity, -Infinity];
        for (const values of [...this.curves.map((curve) => curve[which]), holds === undefined ? [] : [holds]]) {
            for (let k = 0; k < values.length; k++) {
                const value = values[k];
                if (Number.isFinite(value) && (!log || value > 0)) {
                    if (value < low) low = value;
                    if (value > high) high = value;
                }
            }
        }
        if (low > high) return log ? [0.1, 1] : [0, 1];
        if (log) return [low / 1.3, high * 1.5];
        if (low === high) return around(low);
        const room = hasRoom ? 0.06 * (high - low) : 0;
        return [low - room, high + room];
    }

    private size(): Size {
        return { width: Math.max(60, this.host.clientWidth), height: Math.max(50, this.host.clientHeight) };
    }

    private resize(): void {
        this.setSize(this.size());
    }

    /** Draws the plot at a size before it returns. */
    private setSize(size: Size): void {
        const { plot } = this;
        plot?.batch(() => {
            plot.setSize(size);
            if (this.round) plot.setData(this.dummy());
        });
    }

    /** Ends of an axis: those of a circle have equal scales, and the shorter side shows all of it. */
    private shownEnds(index: 0 | 1, { width, height }: uPlot): Range {
        const sides = [width, height].map((side, k) => Math.max(20, side - AROUND[k]));
        const [low, high] = this.ends[index];
        const factor = this.round ? sides[index] / Math.min(...sides) : 1;
        return [factor * low, factor * high];
    }

    private build(): void {
        this.plot?.destroy();
        const scale = (index: 0 | 1, log?: boolean): uPlot.Scale => ({
            time: false,
            distr: log ? 3 : 1,
            range: (plot) => this.shownEnds(index, plot),
        });
        this.axes = [
            new ChartAxis(this.x, () => this.ends[0], 2, this.compact, () => false),
            new ChartAxis(this.y, () => this.ends[1], 3, this.compact, () => this.isEmpty),
        ];
        const plot = new uPlot(
            {
                ...this.size(),
                padding: [this.compact ? 6 : 10, this.compact ? 8 : 14, 0, 0],
                legend: { show: false },
                cursor: { show: false },
                scales: { x: scale(0, this.x.log), y: scale(1, this.y.log) },
                axes: this.axes.map((own) => own.options),
                series: [{}, { paths: () => null, points: { show: false } }],
                hooks: { draw: [(made) => this.draw(made)] },
            },
            this.dummy(),
            this.host,
        );
        this.plot = plot;
    }

    private draw(plot: uPlot): void {
        const { ctx, bbox } = plot;
        for (const axis of this.axes) axis.drawTitle(plot);
        ctx.save();
        ctx.beginPath();
        ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
        ctx.clip();
        const ratio = devicePixelRatio || 1;
        if (this.round) unitCircle(plot, ratio);
        for (const rule of this.rules) drawRule(plot, rule, this.curves, ratio);
        for (const curve of this.curves) drawCurve(plot, curve, ratio);
        for (const mark of apart(plot, this.marks, ratio)) drawMark(plot, mark, ratio);
        if (this.waiting) drawWords(plot, this.waiting, ratio);
        this.extra?.(plot);
        ctx.restore();
    }
}

/** Ends of an axis for a single value, away from 0 if the value is not 0. */
export function around(value: number): Range {
    const room = 0.06 * Math.abs(value) || 1;
    return [value - room, value + room];
}

/** Ends between which an axis can be divided: finite, further apart than roundoff, and not over too many decades. */
function drawable([low, high]: Range, log = false): Range {
    if (!Number.isFinite(low) || !Number.isFinite(high)) return log ? [0.1, 1] : [0, 1];
    if (log) {
        if (!(high > 0)) return [0.1, 1];
        return [Math.min(Math.max(low, 1e-9 * high), high / 1.5), high];
    }
    const least = 1e-7 * Math.max(Math.abs(low), Math.abs(high), 1e-12);
    return high - low > least ? [low, high] : [low - 1e3 * least, low + 1e3 * least];
}
