// The steps of a drawing on a canvas, repeated on another canvas at another size.

type Context = CanvasRenderingContext2D;

const STEPS = ["beginPath", "moveTo", "lineTo", "closePath", "rect", "arc", "fillRect", "stroke", "fill", "clip", "save", "restore", "fillText"] as const;
const STYLES = ["fillStyle", "strokeStyle", "lineWidth", "lineJoin", "lineCap", "font", "textAlign", "textBaseline", "globalAlpha"] as const;

/** Draws with `draw` on a canvas, and the same on another one: larger by a factor, and so far below its upper end. */
export function mirror(ctx: Context, draw: () => void, target: Context, factor: number, top: number): void {
    const methods = ctx as unknown as Record<string, unknown>;
    const before = target.getTransform();
    for (const name of STEPS) {
        const own = Object.getPrototypeOf(ctx)[name] as (...values: unknown[]) => void;
        methods[name] = (...values: unknown[]) => {
            for (const style of STYLES) (target as unknown as Record<string, unknown>)[style] = ctx[style];
            target.setLineDash(ctx.getLineDash());
            const { a, b, c, d, e, f } = ctx.getTransform();
            target.setTransform(factor * a, factor * b, factor * c, factor * d, factor * e, factor * f + top);
            own.apply(target, values);
            own.apply(ctx, values);
        };
    }
    try {
        draw();
    } finally {
        for (const name of STEPS) delete methods[name];
        target.setTransform(before);
    }
}
