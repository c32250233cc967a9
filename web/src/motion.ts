// Slow motion of the beams and plates with their impacts.

import { colour } from "./theme";
import type { Frame } from "./frame";
import type { Plates } from "./plates";
import type { Drawn } from "./print";
import { record } from "./recorder";

interface Beam {
    name: string;
    places: Float64Array;
    motion: Float64Array;
    lowest: number;
    highest: number;
}

interface Stop {
    name: string;
    gap: number;
    at: { beam: string; place: number } | null;
    above: boolean;
    /** Element that carries the stop. */
    frame: string | null;
    force: Float64Array;
    /** Displacement towards the stop; contact begins at the gap. */
    displacement: Float64Array;
}

interface Layout {
    /** Device pixels of a CSS pixel. */
    ratio: number;
    own: Stop[];
    /** Device pixels of a metre of displacement. */
    scale: number;
    zero: number;
    left: number;
    right: number;
    length: number;
    x: (place: number) => number;
}

export class Motion implements Drawn {
    private beams: Beam[] = [];
    private stops: Stop[] = [];
    private pictures = 0;
    private periodS = 1;
    private phase = 0;
    private last = 0;
    private paused = false;
    /** True while the cursor holds the motion at its time. */
    private held = false;
    private largest = 1;
    /** Factor of the slow motion. */
    slower = 40;
    /** Called with the fraction of the period that is shown. */
    onPhase: (phase: number) => void = () => {};
    readonly frames: number[] = [];

    constructor(readonly canvas: HTMLCanvasElement, private readonly plates: Plates) {
        this.paused = matchMedia("(prefers-reduced-motion: reduce)").matches;
        requestAnimationFrame((time) => this.tick(time));
    }

    get playing(): boolean {
        return !this.paused && !this.held;
    }

    /** Fraction of the period that is shown. */
    get shown(): number {
        return this.phase;
    }

    toggle(): boolean {
        this.paused = !this.paused;
        return !this.paused;
    }

    /** Shows a fraction of the period until the motion is released. */
    hold(phase: number): void {
        this.held = true;
        this.phase = phase;
        this.draw();
        this.onPhase(phase);
    }

    release(): void {
        this.held = false;
    }

    take(frame: Frame): void {
        const { head } = frame;
        this.pictures = head.pictures;
        this.periodS = head.period_s;
        this.stops = (head.stops as Stop[]).map((stop, k) => ({ ...stop, force: frame.array(`force.${k}`), displacement: frame.array(`displacement.${k}`) }));
        this.beams = (head.beams as { name: string }[]).map(({ name }) => {
            const motion = frame.array(`motion.${name}`);
            let [lowest, highest] = [0, 0];
            for (const value of motion) [lowest, highest] = [Math.min(lowest, value), Math.max(highest, value)];
            return { name, places: frame.array(`place.${name}`), motion, lowest, highest };
        });
        this.plates.take(frame);
        this.canvas.hidden = this.beams.length === 0 && (head.plates as unknown[]).length > 0;
        this.largest = Math.max(1e-12, ...this.beams.map((beam) => Math.max(beam.highest, -beam.lowest)));
        this.draw();
    }

    private tick(time: number): void {
        requestAnimationFrame((next) => this.tick(next));
        const passed = Math.min(0.1, (time - this.last) / 1000);
        this.last = time;
        if (!this.playing || this.pictures === 0 || document.hidden) return;
        this.frames.push(time);
        if (this.frames.length > 240) this.frames.shift();
        this.phase = (this.phase + passed / this.slower / this.periodS) % 1;
        this.draw();
        this.onPhase(this.phase);
    }

    draw(): void {
        const { canvas } = this;
        this.plates.show(this.phase);
        const ratio = devicePixelRatio || 1;
        const [width, height] = [canvas.clientWidth * ratio, canvas.clientHeight * ratio];
        if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
        const ctx = canvas.getContext("2d");
        if (!ctx) return;
        ctx.clearRect(0, 0, width, height);
        for (const beam of this.beams) this.beam(ctx, beam);
    }

    printed(): string | undefined {
        return this.svg();
    }

    svg(paper?: string): string | undefined {
        const ctx = this.canvas.getContext("2d");
        return ctx ? record(ctx, () => this.draw(), paper) : undefined;
    }

    /** Stops of a beam, its scale, and positions on the canvas: of its clamp and of its points. */
    private layout(beam: Beam): Layout {
        const ratio = devicePixelRatio || 1;
        const { width, height } = this.canvas;
        const strip = height / Math.max(1, this.beams.length);
        const own = this.stops.filter((stop) => stop.at?.beam === beam.name);
        const room = Math.max(beam.highest, ...own.map((stop) => (stop.above ? stop.gap : 0)), 0.3 * this.largest);
        const below = Math.max(-beam.lowest, ...own.map((stop) => (stop.above ? 0 : stop.gap)), 0.3 * this.largest);
        const scale = (strip - 34 * ratio) / (room + below);
        const [left, right] = [26 * ratio, width - 20 * ratio];
        const length = beam.places[beam.places.length - 1] || 1;
        return { ratio, own, scale, zero: this.beams.indexOf(beam) * strip + 20 * ratio + room * scale, left, right, length, x: (place) => left + ((right - left) * place) / length };
    }

    /** Fraction of the period, the nearest to that shown, at which a beam passes through the pointer or comes nearest to it. */
    phaseAt(event: MouseEvent): number | undefined {
        const { canvas, pictures } = this;
        const box = canvas.getBoundingClientRect();
        const [px, py] = [((event.clientX - box.left) * canvas.width) / box.width, ((event.clientY - box.top) * canvas.height) / box.height];
        const beam = this.beams[Math.min(Math.max(Math.floor((py * this.beams.length) / canvas.height), 0), this.beams.length - 1)];
        if (!beam || pictures === 0) return undefined;
        const { left, right, length, zero, scale } = this.layout(beam);
        const count = beam.places.length;
        const place = (length * (px - left)) / (right - left);
        const k = beam.places.reduce((best, own, index) => (Math.abs(own - place) < Math.abs(beam.places[best] - place) ? index : best), 0);
        const above = Array.from({ length: pictures }, (_, picture) => beam.motion[picture * count + k] - (zero - py) / scale);
        return nearestZero(above, this.phase);
    }

    private beam(ctx: CanvasRenderingContext2D, beam: Beam): void {
        const { ratio, own, scale, zero, left, right, length, x } = this.layout(beam);
        const first = Math.floor(this.phase * this.pictures) % this.pictures;
        const share = this.phase * this.pictures - Math.floor(this.phase * this.pictures);
        const next = (first + 1) % this.pictures;
        const count = beam.places.length;
        const bend = (k: number) => (1 - share) * beam.motion[first * count + k] + share * beam.motion[next * count + k];
        ctx.strokeStyle = colour("grid");
        ctx.lineWidth = ratio;
        line(ctx, left, zero, right, zero);
        // Earlier positions of the beam.
        ctx.strokeStyle = colour("blue");
        ctx.globalAlpha = 0.12;
        for (let picture = 0; picture < this.pictures; picture += 12) this.bent(ctx, (k) => [x(beam.places[k]), zero - scale * beam.motion[picture * count + k]], count);
        ctx.globalAlpha = 1;
        let struck = false;
        for (const stop of own) {
            const place = stop.at!.place;
            const k = Math.min(count - 1, Math.round((place / length) * (count - 1)));
            const isHit = this.now(stop.force) > 0;
            struck ||= isHit;
            // A stop on the ground is fixed; one on a moving element is as far away as the motion towards it says.
            const from = stop.frame === null || stop.frame === "ground" ? 0 : (stop.above ? bend(k) : -bend(k)) - this.now(stop.displacement);
            this.stop(ctx, x(place), zero - (stop.above ? scale : -scale) * (stop.gap + from), stop, isHit, ratio);
        }
        ctx.strokeStyle = colour(struck ? "vermilion" : "beam");
        ctx.lineWidth = 4 * ratio;
        ctx.lineCap = "round";
        this.bent(ctx, (k) => [x(beam.places[k]), zero - scale * bend(k)], count);
        ctx.fillStyle = colour("grey");
        ctx.fillRect(left - 9 * ratio, zero - scale * bend(0) - 13 * ratio, 8 * ratio, 26 * ratio);
    }

    /** Value of a history at the phase that is shown. */
    private now(history: Float64Array): number {
        return history[Math.floor(this.phase * history.length) % history.length] ?? 0;
    }

    private bent(ctx: CanvasRenderingContext2D, at: (k: number) => [number, number], count: number): void {
        ctx.beginPath();
        for (let k = 0; k < count; k++) ctx.lineTo(...at(k));
        ctx.stroke();
    }

    private stop(ctx: CanvasRenderingContext2D, x: number, y: number, stop: Stop, struck: boolean, ratio: number): void {
        const way = (stop.above ? -1 : 1) * ratio;
        ctx.fillStyle = colour(struck ? "vermilion" : "grey");
        ctx.beginPath();
        ctx.arc(x, y + 5 * way, 5 * ratio, 0, 2 * Math.PI);
        ctx.fill();
        ctx.fillRect(x - 5 * ratio, Math.min(y + 5 * way, y + 14 * way), 10 * ratio, 9 * ratio);
        ctx.fillRect(x - 15 * ratio, Math.min(y + 14 * way, y + 17 * way), 30 * ratio, 3 * ratio);
    }
}

function line(ctx: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
    ctx.beginPath();
    ctx.moveTo(x0, y0);
    ctx.lineTo(x1, y1);
    ctx.stroke();
}

/** Fraction of a period, the nearest to `near`, at which a periodic sequence is zero; without one, that of the smallest magnitude. */
function nearestZero(values: number[], near: number): number {
    const count = values.length;
    const zeros = values.flatMap((value, k) => {
        const next = values[(k + 1) % count];
        return value === 0 ? [k / count] : value * next < 0 ? [(k + value / (value - next)) / count] : [];
    });
    const away = (phase: number) => Math.abs(phase - near - Math.round(phase - near));
    if (zeros.length > 0) return zeros.reduce((best, own) => (away(own) < away(best) ? own : best));
    return values.reduce((best, value, k) => (Math.abs(value) < Math.abs(values[best]) ? k : best), 0) / count;
}
