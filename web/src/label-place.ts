// Place of the label of a line on a chart: next to the line, inside the chart, and where it can, away from the curves.

import type uPlot from "uplot";
import type { Curve } from "./paint";

/** Distances of the text from its line and from the edges, and its height, CSS pixels. */
const [AWAY, EDGE, HEIGHT] = [3, 4, 11];
/** Places along the line that are tried. */
const PLACES = 9;

type Point = [number, number];
/** Left, upper, right and lower end. */
type Box = [number, number, number, number];

/** Start of the text of a label on its baseline, device pixels. */
export function labelPlace(plot: uPlot, { at, along, size }: { at: number; along: "x" | "y"; size: number }, curves: Curve[], ratio: number): Point {
    const { left, top, width, height } = plot.bbox;
    const [away, edge, high] = [AWAY * ratio, EDGE * ratio, HEIGHT * ratio];
    const share = (k: number, from: number, room: number) => from + (k / (PLACES - 1)) * Math.max(room, 0);
    const places = Array.from({ length: PLACES }, (_, k): Point[] =>
        along === "y"
            ? [at - away, at + high].map((base): Point => [share(k, left + edge, width - size - 2 * edge), base])
            : [at + away, at - away - size].map((start): Point => [start, share(k, top + high, height - high - edge)]),
    ).flat();
    const inside = places.filter(([x, y]) => x >= left && x + size <= left + width && y - high >= top && y <= top + height);
    const lines = curves.flatMap((curve) => segments(plot, curve));
    const crossings = ([x, y]: Point) => lines.filter(([from, to]) => crosses(from, to, [x - away, y - high, x + size + away, y + away])).length;
    let [best, least] = [inside[0] ?? places[0], Infinity];
    for (const place of inside) {
        const count = crossings(place);
        if (count < least) [best, least] = [place, count];
        if (count === 0) break;
    }
    return best;
}

/** Drawn segments of a curve, device pixels; a point is a segment of its own. */
function segments(plot: uPlot, curve: Curve): [Point, Point][] {
    const at = (k: number): Point => [plot.valToPos(curve.x[k], "x", true), plot.valToPos(curve.y[k], "y", true)];
    const points = Array.from({ length: curve.x.length }, (_, k) => at(k));
    const isPoints = curve.dots !== undefined || curve.shape !== undefined || curve.cell !== undefined;
    const found: [Point, Point][] = [];
    points.forEach((own, k) => {
        const from = isPoints ? own : points[k - 1];
        if (from && (isPoints || !curve.gap?.(k - 1)) && [...from, ...own].every(Number.isFinite)) found.push([from, own]);
    });
    return found;
}

/** Whether a segment enters a box, after Liang and Barsky, ACM Trans. Graphics 3 (1984) 1. */
function crosses([a, b]: Point, [c, d]: Point, [left, top, right, low]: Box): boolean {
    let [from, to] = [0, 1];
    for (const [step, room] of [[a - c, a - left], [c - a, right - a], [b - d, b - top], [d - b, low - b]]) {
        if (step === 0 && room < 0) return false;
        if (step < 0) from = Math.max(from, room / step);
        if (step > 0) to = Math.min(to, room / step);
    }
    return from <= to;
}
