// Legend of a picture: a sample and words for each kind of curve and mark, in rows.

import type uPlot from "uplot";
import { type Mark, DASH, drawMark } from "./paint";
import { colour } from "./theme";

/** A kind of curve or mark of a picture. */
export interface LegendEntry {
    words: string;
    colour: string;
    /** Mark in place of a line. */
    shape?: Mark["shape"];
    /** Area in place of a line. */
    area?: boolean;
    dashed?: boolean;
    alpha?: number;
}

/** Sizes in CSS pixels: the sample, the gap after it, that between entries, and a row. */
const [SAMPLE, GAP, BETWEEN, ROW] = [24, 6, 18, 20];
const FONT = "12px system-ui, sans-serif";

/** Entries with their places, and the height of all rows, CSS pixels. */
function placed(ctx: CanvasRenderingContext2D, entries: LegendEntry[], width: number): { places: [number, number][]; height: number } {
    ctx.font = FONT;
    let [x, y] = [BETWEEN, 0];
    const places = entries.map(({ words }): [number, number] => {
        const own = SAMPLE + GAP + ctx.measureText(words).width;
        if (x > BETWEEN && x + own > width) [x, y] = [BETWEEN, y + ROW];
        const place: [number, number] = [x, y];
        x += own + BETWEEN;
        return place;
    });
    return { places, height: entries.length > 0 ? y + 1.5 * ROW : 0 };
}

/** Height of a legend on a picture of a width, CSS pixels. */
export const legendHeight = (ctx: CanvasRenderingContext2D, entries: LegendEntry[], width: number): number => placed(ctx, entries, width).height;

/** Draws a legend; the units of the context are CSS pixels, and its origin is the corner of the legend. */
export function drawLegend(ctx: CanvasRenderingContext2D, entries: LegendEntry[], width: number): void {
    const { places } = placed(ctx, entries, width);
    // Marks are placed by the axes of a plot; here their values are the pixels.
    const plot = { ctx, valToPos: (value: number) => value } as unknown as uPlot;
    entries.forEach(({ words, colour: own, shape, area, dashed, alpha }, k) => {
        const [x, y] = [places[k][0], places[k][1] + ROW / 2];
        ctx.globalAlpha = alpha ?? 1;
        ctx.fillStyle = ctx.strokeStyle = own;
        if (shape) drawMark(plot, { x: x + SAMPLE / 2, y, colour: own, shape, size: 4 }, 1);
        else if (area) ctx.fillRect(x, y - 6, SAMPLE, 12);
        else {
            ctx.lineWidth = 2;
            ctx.setLineDash(dashed ? DASH : []);
            ctx.beginPath();
            ctx.moveTo(x, y);
            ctx.lineTo(x + SAMPLE, y);
            ctx.stroke();
            ctx.setLineDash([]);
        }
        ctx.globalAlpha = 1;
        ctx.fillStyle = colour("ink");
        ctx.font = FONT;
        [ctx.textAlign, ctx.textBaseline] = ["left", "middle"];
        ctx.fillText(words, x + SAMPLE + GAP, y);
    });
}
