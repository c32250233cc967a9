// What a canvas shows, as SVG: a drawing is done again, and its steps are written down with the state of the context at each step.

type Context = CanvasRenderingContext2D;

/** Family after that of the canvas: that of the program's pictures. */
const FAMILY = '"DejaVu Sans", sans-serif';

/** Clip paths of all documents so far: a page may hold several. */
let clips = 0;

/** Returns an SVG document of what `draw` draws on a canvas, on `paper` if it is given. */
export function record(ctx: Context, draw: () => void, paper?: string): string {
    const recorder = new Recorder(ctx);
    const methods = recorder.methods();
    Object.assign(ctx, methods);
    try {
        draw();
    } finally {
        for (const name of Object.keys(methods)) delete (ctx as unknown as Record<string, unknown>)[name];
    }
    const { width, height } = ctx.canvas;
    const back = paper ? `<rect width="${width}" height="${height}" fill="${paper}"/>` : "";
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">${back}${recorder.finish()}</svg>\n`;
}

class Recorder {
    private body = "";
    /** Path so far, in pixels of the canvas. */
    private steps = "";
    /** Rectangles of one opaque style are one path. */
    private pending: { style: string; steps: string } | undefined;
    /** Groups that each saved state has opened. */
    private groups = [0];

    constructor(private readonly ctx: Context) {}

    /** Methods of the context that draw, and write down what they draw. */
    methods(): Partial<Context> {
        const { ctx } = this;
        const on = <T extends keyof Context>(name: T, write: (...values: number[]) => void) => ({
            [name]: (...values: number[]) => {
                write(...values);
                (Object.getPrototypeOf(ctx)[name] as (...values: number[]) => void).apply(ctx, values);
            },
        });
        return {
            ...on("clearRect", () => ([this.body, this.pending] = ["", undefined])),
            ...on("beginPath", () => (this.steps = "")),
            ...on("moveTo", (x, y) => this.step("M", x, y)),
            ...on("lineTo", (x, y) => this.step(this.steps ? "L" : "M", x, y)),
            ...on("closePath", () => (this.steps += "Z")),
            ...on("rect", (x, y, width, height) => (this.steps += this.box(x, y, width, height))),
            ...on("arc", (x, y, radius, from, to) => this.arc(x, y, radius, from, to)),
            ...on("fillRect", (x, y, width, height) => this.rectangle(this.box(x, y, width, height))),
            ...on("stroke", () => this.path(this.line())),
            ...on("fill", () => this.path(this.area())),
            ...on("clip", () => this.clip()),
            ...on("save", () => this.groups.push(0)),
            ...on("restore", () => this.close(this.groups.pop() ?? 0)),
            ...on("fillText", (words, x, y) => this.text(String(words), x, y)),
        };
    }

    /** Ends the document. */
    finish(): string {
        this.close(this.groups.reduce((sum, own) => sum + own, 0));
        return this.body;
    }

    /** Position on the canvas. */
    private at(x: number, y: number): string {
        const { a, b, c, d, e, f } = this.ctx.getTransform();
        return `${short(a * x + c * y + e)} ${short(b * x + d * y + f)}`;
    }

    private step(kind: string, x: number, y: number): void {
        this.steps += kind + this.at(x, y);
    }

    private box(x: number, y: number, width: number, height: number): string {
        return `M${this.at(x, y)}L${this.at(x + width, y)}L${this.at(x + width, y + height)}L${this.at(x, y + height)}Z`;
    }

    /** An arc in two halves, since an SVG arc cannot be a circle. */
    private arc(x: number, y: number, radius: number, from: number, to: number): void {
        const at = (angle: number) => this.at(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
        const half = (angle: number) => `A${short(radius)} ${short(radius)} 0 0 1 ${at(angle)}`;
        this.steps += `${this.steps ? "L" : "M"}${at(from)}${half((from + to) / 2)}${half(to)}`;
    }

    private rectangle(steps: string): void {
        const style = this.area();
        if (this.pending?.style !== style || this.ctx.globalAlpha < 1) {
            this.flush();
            this.pending = { style, steps: "" };
        }
        this.pending.steps += steps;
    }

    private path(style: string): void {
        this.flush();
        if (this.steps) this.body += `<path d="${this.steps}" ${style}/>`;
    }

    private flush(): void {
        if (this.pending) this.body += `<path d="${this.pending.steps}" ${this.pending.style}/>`;
        this.pending = undefined;
    }

    private area(): string {
        return `fill="${plain(this.ctx.fillStyle)}"${this.opacity("fill")}`;
    }

    private line(): string {
        const { ctx } = this;
        const dash = ctx.getLineDash();
        return `fill="none" stroke="${plain(ctx.strokeStyle)}" stroke-width="${short(ctx.lineWidth)}" stroke-linejoin="${ctx.lineJoin}" stroke-linecap="${ctx.lineCap}"${dash.length > 0 ? ` stroke-dasharray="${dash.map(short).join(" ")}"` : ""}${this.opacity("stroke")}`;
    }

    private opacity(part: "fill" | "stroke"): string {
        return this.ctx.globalAlpha < 1 ? ` ${part}-opacity="${short(this.ctx.globalAlpha)}"` : "";
    }

    private clip(): void {
        this.flush();
        const id = `clip-${clips++}`;
        this.body += `<clipPath id="${id}"><path d="${this.steps}"/></clipPath><g clip-path="url(#${id})">`;
        this.groups[this.groups.length - 1]++;
    }

    private close(groups: number): void {
        this.flush();
        this.body += "</g>".repeat(groups);
    }

    private text(words: string, x: number, y: number): void {
        this.flush();
        if (!words) return;
        const { ctx } = this;
        const [, size, family] = /([\d.]+)px (.*)$/.exec(ctx.font) ?? ["", "10", "sans-serif"];
        const anchor = { center: "middle", right: "end", end: "end" }[ctx.textAlign as string] ?? "start";
        const { a, b, c, d } = ctx.getTransform();
        const turn = b === 0 && c === 0 ? "" : ` transform="matrix(${[a, b, c, d].map(short).join(" ")} ${this.at(x, y)})"`;
        const rise = this.baseline();
        const place = turn ? `x="0" y="${short(rise)}"` : `x="${this.at(x, y + rise).replace(" ", '" y="')}"`;
        this.body += `<text ${place} font-size="${size}" font-family="${escape(`${family.replace(/, sans-serif$/, "")}, ${FAMILY}`)}" text-anchor="${anchor}" ${this.area()}${turn}>${escape(words)}</text>`;
    }

    /** Distance of the baseline of letters below that of the context. */
    private baseline(): number {
        const { ctx } = this;
        const own = ctx.textBaseline;
        const here = ctx.measureText("").fontBoundingBoxAscent;
        ctx.textBaseline = "alphabetic";
        const rise = ctx.measureText("").fontBoundingBoxAscent - here;
        ctx.textBaseline = own;
        return rise;
    }
}

/** A colour that programs other than browsers know too: a mixture is given by its parts. */
function plain(style: Context["fillStyle"]): string {
    const parts = /^color\(srgb ([\d.e-]+) ([\d.e-]+) ([\d.e-]+)\)$/.exec(String(style));
    return parts ? `rgb(${parts.slice(1).map((part) => Math.round(255 * Number(part))).join(",")})` : String(style);
}

function short(value: number): string {
    return String(Math.round(100 * value) / 100);
}

function escape(text: string): string {
    return text.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);
}
