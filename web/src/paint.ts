// Elements on the axes of a chart: curves, which may turn back in x, rules and marks.

import type uPlot from "uplot";
import { labelPlace } from "./label-place";
import { colour } from "./theme";

export interface Curve {
    x: ArrayLike<number>;
    y: ArrayLike<number>;
    colour: string;
    width?: number;
    alpha?: number;
    /** Segments between points that are dashed. */
    dashed?: (from: number) => boolean;
    /** Segments between points that are not drawn. */
    gap?: (from: number) => boolean;
    /** Points instead of a line. */
    dots?: number;
    /** Points as marks instead of a line. */
    shape?: Mark["shape"];
    size?: number;
    /** Points as cells of this width and height, in the units of the axes. */
    cell?: [number, number];
    /** Upper end of an area that is filled from `y` on. */
    upper?: ArrayLike<number>;
    /** Opacity of the area at a point, relative to `alpha`; 0 ends it. */
    fill?: (at: number) => number;
    /** Name of the curve, written at its first point. */
    words?: string;
    /** Stems down to the lowest value. */
    stems?: boolean;
}

export interface Mark {
    x: number;
    y: number;
    colour: string;
    shape: "circle" | "square" | "diamond" | "triangle" | "cross" | "plus" | "ring" | "up" | "down";
    size?: number;
    /** Not drawn next to an earlier one that yields. */
    yields?: boolean;
}

export interface Rule {
    at: number;
    along: "x" | "y";
    words?: string;
    /** Solid and in the colour of controls: the line can be dragged. */
    strong?: boolean;
}

export const DASH = [6, 5];

/** Unit circle of the multipliers. */
export function unitCircle(plot: uPlot, ratio: number): void {
    const { ctx } = plot;
    ctx.strokeStyle = colour("grey");
    ctx.lineWidth = ratio;
    ctx.beginPath();
    for (let k = 0; k <= 90; k++) {
        const angle = (k * Math.PI) / 45;
        ctx.lineTo(plot.valToPos(Math.cos(angle), "x", true), plot.valToPos(Math.sin(angle), "y", true));
    }
    ctx.stroke();
}

export function drawRule(plot: uPlot, rule: Rule, curves: Curve[], ratio: number): void {
    const { ctx, bbox } = plot;
    const at = plot.valToPos(rule.at, rule.along === "x" ? "x" : "y", true);
    ctx.strokeStyle = colour(rule.strong ? "accent" : "grey");
    ctx.lineWidth = (rule.strong ? 1.6 : 1) * ratio;
    ctx.setLineDash(rule.strong ? [] : [3 * ratio, 3 * ratio]);
    ctx.beginPath();
    if (rule.along === "x") {
        ctx.moveTo(at, bbox.top);
        ctx.lineTo(at, bbox.top + bbox.height);
    } else {
        ctx.moveTo(bbox.left, at);
        ctx.lineTo(bbox.left + bbox.width, at);
    }
    ctx.stroke();
    ctx.setLineDash([]);
    if (rule.words) {
        ctx.fillStyle = colour(rule.strong ? "accent" : "quiet");
        ctx.font = `${10 * ratio}px system-ui, sans-serif`;
        [ctx.textAlign, ctx.textBaseline] = ["left", "alphabetic"];
        ctx.fillText(rule.words, ...labelPlace(plot, { at, along: rule.along, size: ctx.measureText(rule.words).width }, curves, ratio));
    }
}

/** Words in the middle of the chart. */
export function drawWords({ ctx, bbox }: uPlot, words: string, ratio: number): void {
    ctx.fillStyle = colour("quiet");
    ctx.font = `${14 * ratio}px system-ui, sans-serif`;
    [ctx.textAlign, ctx.textBaseline] = ["center", "middle"];
    ctx.fillText(words, bbox.left + bbox.width / 2, bbox.top + bbox.height / 2);
}

export function drawCurve(plot: uPlot, curve: Curve, ratio: number): void {
    const { ctx, bbox } = plot;
    ctx.globalAlpha = curve.alpha ?? 1;
    ctx.strokeStyle = ctx.fillStyle = curve.colour;
    ctx.lineWidth = (curve.width ?? 1.6) * ratio;
    ctx.lineJoin = "round";
    const at = (k: number): [number, number] => [plot.valToPos(curve.x[k], "x", true), plot.valToPos(curve.y[k], "y", true)];
    if (curve.upper) {
        area(plot, curve, curve.upper);
    } else if (curve.shape) {
        for (let k = 0; k < curve.x.length; k++) drawMark(plot, { x: curve.x[k], y: curve.y[k], colour: curve.colour, shape: curve.shape, size: curve.size }, ratio);
    } else if (curve.cell) {
        cells(plot, curve, curve.cell);
    } else if (curve.dots || curve.stems) {
        for (let k = 0; k < curve.x.length; k++) {
            const [x, y] = at(k);
            if (curve.stems) ctx.fillRect(x - ratio, y, 2 * ratio, bbox.top + bbox.height - y);
            else ctx.fillRect(x - curve.dots! * ratio, y - curve.dots! * ratio, 2 * curve.dots! * ratio, 2 * curve.dots! * ratio);
        }
    } else {
        line(ctx, curve, at, ratio);
    }
    if (curve.words && curve.x.length > 0) drawName(plot, curve.words, curve, ratio);
    ctx.globalAlpha = 1;
}

/** Writes the name of a curve at its first point: above the part that is as long as the name, or below it where there is no room above. */
function drawName({ ctx, bbox, valToPos }: uPlot, words: string, curve: Curve, ratio: number): void {
    const [size, away] = [10 * ratio, 6 * ratio];
    ctx.font = `${size}px system-ui, sans-serif`;
    [ctx.textAlign, ctx.textBaseline] = ["left", "alphabetic"];
    const points = Array.from(curve.x, (x, k) => [valToPos(x, "x", true), valToPos(curve.y[k], "y", true)]);
    const left = points[0][0] + away;
    const heights = points.filter(([x, y]) => x <= left + ctx.measureText(words).width && Number.isFinite(y)).map(([, y]) => y);
    const above = Math.min(...heights) - away;
    ctx.fillText(words, left, above - size >= bbox.top ? above : Math.max(...heights) + away + size);
}

/** Area between two curves: one path for each run of points of one opacity. */
function area({ ctx, valToPos }: uPlot, curve: Curve, upper: ArrayLike<number>): void {
    const alpha = ctx.globalAlpha;
    const opacity = (k: number) => curve.fill?.(k) ?? 1;
    const at = (k: number, values: ArrayLike<number>): [number, number] => [valToPos(curve.x[k], "x", true), valToPos(values[k], "y", true)];
    for (let first = 0; first + 1 < curve.x.length; ) {
        const own = Math.min(opacity(first), opacity(first + 1));
        let last = first + 1;
        while (last + 1 < curve.x.length && Math.min(opacity(last), opacity(last + 1)) === own) last++;
        if (own > 0) {
            ctx.globalAlpha = alpha * own;
            ctx.beginPath();
            for (let k = first; k <= last; k++) ctx.lineTo(...at(k, curve.y));
            for (let k = last; k >= first; k--) ctx.lineTo(...at(k, upper));
            ctx.fill();
        }
        first = last;
    }
}

/** Cells without gaps: each ends at the device pixel where the next begins. */
function cells({ ctx, valToPos }: uPlot, curve: Curve, [width, height]: [number, number]): void {
    for (let k = 0; k < curve.x.length; k++) {
        const [left, right] = [-0.5, 0.5].map((side) => Math.round(valToPos(curve.x[k] + side * width, "x", true)));
        const [top, bottom] = [0.5, -0.5].map((side) => Math.round(valToPos(curve.y[k] + side * height, "y", true)));
        ctx.fillRect(left, top, right - left, bottom - top);
    }
}

/** One path for each run of segments of one kind. */
function line(ctx: CanvasRenderingContext2D, curve: Curve, at: (k: number) => [number, number], ratio: number): void {
    let before: boolean | undefined;
    for (let k = 0; k + 1 < curve.x.length; k++) {
        const dashed = curve.dashed?.(k) ?? false;
        if (dashed !== before) {
            if (before !== undefined) ctx.stroke();
            ctx.setLineDash(dashed ? DASH.map((length) => length * ratio) : []);
            ctx.beginPath();
            ctx.moveTo(...at(k));
            before = dashed;
        }
        // A value of 0 has no place on a logarithmic axis: the line ends before it and begins anew after it.
        if (curve.gap?.(k) || !at(k).every(Number.isFinite)) ctx.moveTo(...at(k + 1));
        else ctx.lineTo(...at(k + 1));
    }
    if (before !== undefined) ctx.stroke();
    ctx.setLineDash([]);
}

/** Marks without those that yield to an earlier one: between two of them there is room for a third. */
export function apart(plot: uPlot, marks: Mark[], ratio: number): Mark[] {
    const drawn: [number, number][] = [];
    return marks.filter((mark) => {
        if (!mark.yields) return true;
        const [x, y] = [plot.valToPos(mark.x, "x", true), plot.valToPos(mark.y, "y", true)];
        if (drawn.some(([left, top]) => Math.hypot(x - left, y - top) < 4 * (mark.size ?? 0) * ratio)) return false;
        drawn.push([x, y]);
        return true;
    });
}

export function drawMark(plot: uPlot, mark: Mark, ratio: number): void {
    const { ctx } = plot;
    const [x, y] = [plot.valToPos(mark.x, "x", true), plot.valToPos(mark.y, "y", true)];
    const r = (mark.size ?? 4.5) * ratio;
    ctx.strokeStyle = ctx.fillStyle = mark.colour;
    ctx.lineWidth = 1.8 * ratio;
    ctx.beginPath();
    if (mark.shape === "circle" || mark.shape === "ring") ctx.arc(x, y, r, 0, 2 * Math.PI);
    else if (mark.shape === "square") ctx.rect(x - 0.85 * r, y - 0.85 * r, 1.7 * r, 1.7 * r);
    else if (mark.shape === "diamond") polygon(ctx, [[x, y - 1.2 * r], [x + 1.2 * r, y], [x, y + 1.2 * r], [x - 1.2 * r, y]]);
    else if (mark.shape === "triangle") polygon(ctx, [[x, y - 1.2 * r], [x + 1.1 * r, y + r], [x - 1.1 * r, y + r]]);
    else if (mark.shape === "up") polygon(ctx, [[x, y - r], [x + r, y + 0.8 * r], [x - r, y + 0.8 * r]]);
    else if (mark.shape === "down") polygon(ctx, [[x, y + r], [x + r, y - 0.8 * r], [x - r, y - 0.8 * r]]);
    else if (mark.shape === "plus") {
        for (const [dx, dy] of [[r, 0], [0, r]]) {
            ctx.moveTo(x - dx, y - dy);
            ctx.lineTo(x + dx, y + dy);
        }
        ctx.stroke();
        return;
    } else {
        ctx.moveTo(x - r, y - r);
        ctx.lineTo(x + r, y + r);
        ctx.moveTo(x + r, y - r);
        ctx.lineTo(x - r, y + r);
        ctx.stroke();
        return;
    }
    if (mark.shape === "ring" || mark.shape === "up" || mark.shape === "down") ctx.stroke();
    else ctx.fill();
}

function polygon(ctx: CanvasRenderingContext2D, corners: [number, number][]): void {
    corners.forEach(([x, y], k) => (k === 0 ? ctx.moveTo(x, y) : ctx.lineTo(x, y)));
    ctx.closePath();
}
