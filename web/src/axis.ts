// An axis of a chart: its numbers with their unit, its title, and the room that both need.

import uPlot from "uplot";
import { colour } from "./theme";
import { lines, logLabels } from "./ticks";
import { axisUnit, digits, isPlain, logAxisUnit, scientific } from "./units";

export interface Axis {
    words: string;
    unit: string;
    log?: boolean;
    /** Fixed ends; by default those of the curves. */
    ends?: [number, number];
    /** A value that the axis shows in addition to those of the curves. */
    holds?: number;
    /** Room between the curves and the ends of a horizontal axis: the curves turn back there. */
    room?: boolean;
    /** Divisor and unit of the labels; by default those of the largest value. */
    scale?: [number, string];
    /** True where the values are 0 and 1, which the labels call no and yes. */
    flag?: boolean;
}

export type Range = [number, number];

/** Divisor and unit of the numbers of an axis with these ends. */
export function axisScale(axis: Axis, [low, high]: Range): [number, string] {
    return axis.scale ?? (axis.log ? logAxisUnit : axisUnit)(low, high, axis.unit);
}

/** Pixels of axes and margins in a small chart, horizontally and vertically. */
export const AROUND = [56, 38];

/** Room for a label of a logarithmic axis, horizontally and vertically, CSS pixels. */
const SPACE = [60, 18];

/** Sizes of letters, CSS pixels: of the numbers, of the first line of a title, of each further line. */
const LETTERS = { large: [12, 18, 15], small: [10, 14, 12] };
/** Least room for the numbers below and at the left of a chart, and their distance from it. */
const NUMBERS = { large: [19, 48], small: [16, 34] };
const GAP = 3;
/** Distance of letters from the edge of the canvas. */
const EDGE = 2;

const FAMILY = "system-ui, sans-serif";

/** An axis below or at the left of a chart; `ends` are the present ones, `bare` is true where it has no numbers. */
export class ChartAxis {
    private readonly kind: "large" | "small";
    private readonly index: 0 | 1;
    private readonly title: string;
    private readonly step: number;

    constructor(private readonly axis: Axis, private readonly ends: () => Range, private readonly side: 2 | 3, compact: boolean, private readonly bare: () => boolean) {
        [this.kind, this.index] = [compact ? "small" : "large", side === 2 ? 0 : 1];
        const [step, unit] = axisScale(axis, ends());
        [this.step, this.title] = [step, unit ? `${axis.words} (${unit})` : axis.words];
    }

    /** The axis as the library takes it. The title is drawn by `drawTitle`. */
    get options(): uPlot.Axis {
        const { axis, kind, side } = this;
        return {
            side,
            font: `${LETTERS[kind][0]}px ${FAMILY}`,
            size: (plot, values) => this.numbers(plot, values) + this.titleSize(plot),
            gap: GAP,
            space: { large: [60, 30], small: [45, 13] }[kind][this.index],
            stroke: colour("ink"),
            grid: { stroke: colour("grid"), width: 1 },
            ticks: { show: false },
            // uPlot 1.6.32 loops forever where a logarithmic axis begins just below a power of ten.
            ...(axis.log ? { splits: (_: uPlot, __: number, low: number, high: number) => lines(low, high), filter: (_: uPlot, splits: number[]) => splits } : {}),
            ...(axis.flag ? { splits: (_: uPlot, __: number, low: number, high: number) => [0, 1].filter((value) => value >= low && value <= high) } : {}),
            values: (plot, splits) => this.labels(plot, splits),
        };
    }

    private labels(plot: uPlot, splits: number[]): string[] {
        const { axis, index, step } = this;
        const [low, high] = this.ends();
        const room = (index === 0 ? plot.width : plot.height) - AROUND[index];
        const labelled = axis.log ? logLabels(low, high, SPACE[index] / Math.max(room, SPACE[index])) : splits;
        const words = (value: number) => (axis.flag ? (value === 1 ? "yes" : "no") : axis.log && !isPlain(low / step, high / step) ? scientific(value / step) : digits(value / step, 6));
        const isShown = (value: number | null) => value !== null && !this.bare() && labelled.some((own) => Math.abs(own - value) <= 1e-9 * Math.abs(own));
        return splits.map((value) => (isShown(value) ? words(value) : ""));
    }

    /** Room for the numbers; the library asks with none before it knows them. */
    private numbers(plot: uPlot, values: string[] | null): number {
        const least = NUMBERS[this.kind][this.index];
        if (this.index === 0 || !values) return least;
        const ratio = devicePixelRatio || 1;
        this.setFont(plot);
        return Math.max(least, ...values.map((own) => plot.ctx.measureText(own).width / ratio + 2 * GAP));
    }

    private titleSize(plot: uPlot): number {
        const [, first, next] = LETTERS[this.kind];
        return first + (this.titleLines(plot).length - 1) * next;
    }

    private setFont({ ctx }: uPlot): void {
        ctx.font = `${LETTERS[this.kind][0] * (devicePixelRatio || 1)}px ${FAMILY}`;
    }

    /** The title in as few lines as the side of the chart has room for. */
    private titleLines(plot: uPlot): string[] {
        const { ctx } = plot;
        this.setFont(plot);
        const most = ((this.index === 0 ? plot.width : plot.height) - 2 * EDGE) * (devicePixelRatio || 1);
        return this.title.split(" ").reduce((found: string[], word) => {
            const longer = found.length > 0 ? `${found[found.length - 1]} ${word}` : word;
            if (found.length === 0 || ctx.measureText(longer).width > most) return [...found, word];
            return [...found.slice(0, -1), longer];
        }, []);
    }

    /** Draws the title in the middle of its side, inside the canvas. */
    drawTitle(plot: uPlot): void {
        const { ctx, bbox } = plot;
        const { canvas } = ctx;
        const ratio = devicePixelRatio || 1;
        const [letters, , next] = LETTERS[this.kind].map((size) => size * ratio);
        const found = this.titleLines(plot);
        const [start, size, whole] = this.index === 0 ? [bbox.left, bbox.width, canvas.width] : [bbox.top, bbox.height, canvas.height];
        ctx.save();
        this.setFont(plot);
        ctx.fillStyle = colour("ink");
        [ctx.textAlign, ctx.textBaseline] = ["center", "alphabetic"];
        if (this.index === 1) {
            ctx.translate(0, canvas.height);
            ctx.rotate(-Math.PI / 2);
        }
        found.forEach((words, k) => {
            const half = ctx.measureText(words).width / 2;
            const edge = EDGE * ratio + half;
            const middle = Math.max(edge, Math.min(start + size / 2, whole - edge));
            const along = this.index === 0 ? middle : canvas.height - middle;
            const across = this.index === 0 ? canvas.height - (found.length - 1 - k) * next - 0.45 * letters : letters + EDGE * ratio + k * next;
            ctx.fillText(words, along, across);
        });
        ctx.restore();
    }
}
