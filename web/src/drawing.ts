// The harvester to scale: the drawing of `jounce show`, whose stop, gap and patch ends can be dragged.

import type { Controls } from "./controls";
import type { Design } from "./design";

interface Drawn {
    svg: string;
    beams: { name: string; length: number }[];
    patches: { name: string; beam: number; start: string; length: string }[];
    stops: { name: string; beam: number | null; gap: string; gap_m: number; place: string | null; above: boolean }[];
}

const SVG = "http://www.w3.org/2000/svg";
/** Width of what can be caught, drawing units. */
const CATCH = 14;
/** Height of the first side view with its title, and of a closer look. */
const [SIDE_TOP, LOOK_TOP] = [40, 12];

export class Drawing {
    svg = "";
    private held: { move: (dx: number, dy: number, moving: boolean) => void; x: number; y: number; scale: number } | undefined;

    constructor(private readonly side: HTMLElement, private readonly close: HTMLElement, private readonly controls: Controls, private readonly design: Design) {
        addEventListener("pointermove", (event) => this.drag(event, true));
        addEventListener("pointerup", (event) => {
            this.drag(event, false);
            this.held = undefined;
        });
    }

    take(drawn: Drawn): void {
        this.svg = drawn.svg;
        const focused = document.activeElement?.getAttribute("data-handle");
        const parsed = new DOMParser().parseFromString(drawn.svg, "image/svg+xml").documentElement;
        const whole = document.importNode(parsed, true) as unknown as SVGSVGElement;
        const [width, height] = ["width", "height"].map((name) => Number(whole.getAttribute(name)));
        // Closer looks begin below the bar that tells the scale; the side views stand above it.
        const windows = [...whole.children].filter((child) => child.tagName === "svg");
        const split = windows.length > 0 ? Number(windows[0].getAttribute("y")) - 26 : height;
        const near = whole.cloneNode(true) as SVGSVGElement;
        prune(whole, (y) => y < split);
        prune(near, (y) => y >= split);
        this.crop(whole, 0, SIDE_TOP, width, split - SIDE_TOP);
        this.crop(near, LOOK_TOP, split, Math.min(width, 10 + 285 * Math.max(1, windows.length)), height - split);
        near.setAttribute("aria-label", "Closer look at the stops");
        whole.setAttribute("aria-label", "Side view to scale");
        for (const svg of [whole, near]) svg.setAttribute("role", "group");
        this.handles(whole, near, drawn);
        this.side.replaceChildren(whole);
        this.close.replaceChildren(...(windows.length > 0 ? [near] : []));
        this.close.hidden = windows.length === 0;
        if (focused) document.querySelector<SVGElement>(`[data-handle="${focused}"]`)?.focus();
    }

    private crop(svg: SVGSVGElement, x: number, y: number, width: number, height: number): void {
        svg.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
        svg.removeAttribute("width");
        svg.removeAttribute("height");
    }

    private handles(side: SVGSVGElement, near: SVGSVGElement, drawn: Drawn): void {
        const beams = [...side.querySelectorAll(":scope > .jounce-beam")].map((beam, k) => {
            const [x, y, width, height] = ["x", "y", "width", "height"].map((name) => Number(beam.getAttribute(name)));
            return { x, y, height, scale: width / (drawn.beams[k]?.length ?? 1) };
        });
        const patches = [...side.querySelectorAll(":scope > .jounce-patch")];
        drawn.patches.forEach((patch, k) => {
            const beam = beams[patch.beam];
            const rect = patches[k];
            if (!beam || !rect) return;
            const [x, y, width] = ["x", "y", "width"].map((name) => Number(rect.getAttribute(name)));
            this.patch(side, patch, [x, x + width], y, beam.scale);
        });
        const tips = [...side.querySelectorAll(":scope > path.jounce-stop")] as SVGPathElement[];
        const windows = [...near.children].filter((child) => child.tagName === "svg") as SVGSVGElement[];
        drawn.stops.forEach((stop, k) => {
            const beam = stop.beam === null ? undefined : beams[stop.beam];
            const [x, y] = firstPoint(tips[k]);
            if (stop.place && beam) this.stop(side, stop.name, stop.place, x + 5, y, beam.scale);
            if (windows[k]) this.gap(windows[k], stop);
        });
    }

    private patch(svg: SVGSVGElement, patch: Drawn["patches"][0], [from, to]: [number, number], y: number, scale: number): void {
        const [start, length] = [this.controls.find(patch.start)?.value, this.controls.find(patch.length)?.value];
        if (start === undefined || length === undefined) return;
        const words = (key: string, si: number): [string, string] => [key, this.controls.words(key, Math.max(0, si))];
        // The far end stays where it is when the near one moves.
        this.handle(svg, `${patch.start}`, from, y, "left", `Start of patch ${patch.name}`, start, (dx, _, moving) => {
            const moved = Math.min(Math.max(dx / scale, -start), 0.98 * length);
            this.design.setAll([words(patch.start, start + moved), words(patch.length, length - moved)], moving);
        });
        this.handle(svg, `${patch.length}`, to, y, "right", `End of patch ${patch.name}`, start + length, (dx, _, moving) => {
            this.design.setAll([words(patch.length, Math.max(0.02 * length, length + dx / scale))], moving);
        });
    }

    private stop(svg: SVGSVGElement, name: string, key: string, x: number, y: number, scale: number): void {
        const place = this.controls.find(key)?.value;
        if (place === undefined) return;
        this.handle(svg, key, x, y, "stop", `Place of stop ${name}`, place, (dx, _, moving) => {
            this.design.set(key, this.controls.words(key, Math.max(0, place + dx / scale)), moving);
        });
    }

    private gap(view: SVGSVGElement, stop: Drawn["stops"][0]): void {
        const tip = view.querySelector<SVGPathElement>("path.jounce-stop");
        const beam = view.querySelector(".jounce-beam");
        const gap = this.controls.find(stop.gap)?.value;
        if (!tip || !beam || gap === undefined || gap <= 0) return;
        const [top, high] = [Number(beam.getAttribute("y")), Number(beam.getAttribute("height"))];
        const numbers = (tip.getAttribute("d") ?? "").match(/-?[\d.]+/g)!.map(Number);
        const heights = numbers.filter((_, k) => k % 2 === 1);
        const face = stop.above ? Math.max(...heights) : Math.min(...heights);
        const scale = (stop.above ? top - face : face - top - high) / gap;
        if (!(scale > 0)) return;
        const middle = (numbers[0] + Math.max(...numbers.filter((_, k) => k % 2 === 0))) / 2;
        this.handle(view, stop.gap, middle, face, "gap", `Gap of stop ${stop.name}`, gap, (_, dy, moving) => {
            const si = gap + ((stop.above ? -dy : dy) / scale);
            this.design.set(stop.gap, this.controls.words(stop.gap, Math.max(0.01 * gap, si)), moving);
        });
    }

    private handle(svg: SVGSVGElement, key: string, x: number, y: number, kind: string, words: string, value: number, move: (dx: number, dy: number, moving: boolean) => void): void {
        const group = document.createElementNS(SVG, "g");
        const area = document.createElementNS(SVG, "rect");
        const vertical = kind === "gap";
        const size = vertical ? [60, 40] : [CATCH, 44];
        for (const [name, number] of Object.entries({ x: x - size[0] / 2, y: y - size[1] / 2, width: size[0], height: size[1], rx: 4 })) area.setAttribute(name, String(number));
        group.setAttribute("class", `handle ${vertical ? "vertical" : "horizontal"}`);
        group.setAttribute("data-handle", key);
        group.setAttribute("tabindex", "0");
        group.setAttribute("role", "slider");
        group.setAttribute("aria-label", words);
        group.setAttribute("aria-orientation", vertical ? "vertical" : "horizontal");
        group.setAttribute("aria-valuenow", String(value));
        group.setAttribute("aria-valuetext", this.controls.words(key, value));
        const tip = document.createElementNS(SVG, "title");
        tip.textContent = `${words}: drag, or use the arrow keys`;
        group.append(tip, area);
        group.addEventListener("pointerdown", (event) => {
            const matrix = svg.getScreenCTM();
            this.held = { move, x: event.clientX, y: event.clientY, scale: matrix?.a ?? 1 };
            group.focus();
            event.preventDefault();
        });
        group.addEventListener("keydown", (event) => {
            const step = ({ ArrowRight: [2, 0], ArrowLeft: [-2, 0], ArrowUp: [0, -2], ArrowDown: [0, 2] } as Record<string, [number, number]>)[event.key];
            if (!step) return;
            event.preventDefault();
            move(step[0], step[1], false);
        });
        svg.append(group);
    }

    private drag(event: PointerEvent, moving: boolean): void {
        if (!this.held) return;
        const { move, x, y, scale } = this.held;
        move((event.clientX - x) / scale, (event.clientY - y) / scale, moving);
    }
}

/** Keeps the children of a drawing whose first place passes; its title and paper go. */
function prune(svg: SVGSVGElement, keep: (y: number) => boolean): void {
    for (const child of [...svg.children]) {
        const y = child.getAttribute("y") ?? (child.tagName === "path" ? String(firstPoint(child as SVGPathElement)[1]) : null);
        if (y === null || !keep(Number(y))) child.remove();
    }
}

/** The first place of a path. */
function firstPoint(path: SVGPathElement | undefined): [number, number] {
    const [x, y] = (path?.getAttribute("d") ?? "").match(/-?[\d.]+/g) ?? ["0", "0"];
    return [Number(x), Number(y)];
}
