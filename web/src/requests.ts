// Order of requests: one coarse response is computed at a time, only the newest position waits for it, older ones are dropped.

import type { ResponseResult, Place } from "./branches";
import type { Axes } from "./axes";
import type { Design } from "./design";
import type { Fault, Frame, Head } from "./frame";
import type { Response } from "./response";
import type { Wire } from "./wire";

interface Hears {
    say: (words: string) => void;
    orbit: (frame: Frame) => void;
    fault: (faults: Fault[]) => void;
}

/** Time without a response after which the page shows that it computes. */
const PATIENCE_MS = 333;
/** Time after which a newer position cancels the computation of an older one. */
const STALE_MS = 4000;
const SWEEP_POINTS = 61;

export class Requests {
    /** Times of changes that are not requested yet. */
    private designWaits: number | undefined;
    private waiting: number | undefined;
    private designAsked = false;
    private coarseAsked = false;
    private asked = 0;
    private since = 0;
    private orbitAsked = false;
    private clicked = 0;
    private orbitWaiting: Place | undefined;
    private sweeping = false;
    /** True while a fine response is expected. */
    private refining = false;
    private readonly busy = document.getElementById("busy")!;

    constructor(private readonly wire: Wire, private readonly design: Design, private readonly axes: Axes, private readonly response: Response, private readonly hears: Hears) {
        wire.on("orbit", (frame) => this.takeOrbit(frame));
        wire.on("sweep", (frame) => this.takeSwept(frame.head));
        setInterval(() => this.patience(), 100);
    }

    /** Registers a change of the design at a time of `performance.now()`. */
    change(time: number): void {
        this.waiting = this.designWaits = time;
        this.pump();
    }

    /** Clears all requests after the connection is lost. */
    forget(): void {
        this.designAsked = this.coarseAsked = this.refining = this.orbitAsked = this.sweeping = false;
        this.busy.textContent = "";
        this.mark();
    }

    private pump(): void {
        const set = this.design.pairs;
        if (this.designWaits !== undefined && !this.designAsked) {
            this.designWaits = undefined;
            this.designAsked = this.wire.ask("design", { set }) !== 0;
        }
        // A long computation is cancelled; a short one is completed, so that the curve follows a moving slider.
        const late = performance.now() - this.asked > STALE_MS;
        if (this.waiting !== undefined && this.axes.view && (!this.coarseAsked || late)) {
            this.since = this.waiting;
            this.waiting = undefined;
            this.askResponse();
        }
        this.mark();
    }

    private askResponse(): void {
        this.asked = performance.now();
        this.refining = this.coarseAsked = this.wire.ask("response", { set: this.design.pairs, ...this.axes.view }) !== 0;
    }

    /** Marks the busy parts for screen readers. */
    private mark(): void {
        const due = {
            drawing: this.designAsked || this.designWaits !== undefined,
            "chart-response": this.refining || this.coarseAsked || this.waiting !== undefined,
            orbit: this.orbitAsked || this.orbitWaiting !== undefined,
        };
        for (const [id, isDue] of Object.entries(due)) document.getElementById(id)!.ariaBusy = String(isDue);
    }

    designTaken(): void {
        this.designAsked = false;
        this.hears.fault([]);
        // The first design specifies the range of the response.
        this.pump();
    }

    designFault(head: Head): void {
        this.designAsked = false;
        this.hears.fault(head.faults);
        this.pump();
    }

    responseFault(head: Head): void {
        this.coarseAsked = this.refining = false;
        this.busy.textContent = "";
        this.hears.fault(head.faults);
        this.pump();
    }

    responseTaken(head: Head, result: ResponseResult): void {
        this.response.take(result);
        const { chosen } = this.response;
        if (chosen) this.orbit(chosen);
        if (head.stage === "coarse") {
            const since = this.since;
            // Measured to the frame that shows the branch, with the server's own time.
            requestAnimationFrame(() => performance.measure("slider-to-branch", { start: since, detail: head.ms }));
            this.coarseAsked = false;
            this.busy.textContent = this.waiting === undefined ? "refining" : "";
            this.pump();
        } else {
            this.busy.textContent = "";
            this.refining = false;
            this.mark();
            this.hears.say(found(result.branches.length, head.ms));
        }
    }

    /** Requests the orbit of a point; the newest request waits for the running one. */
    orbit(place: Place): void {
        if (this.orbitAsked) {
            this.orbitWaiting = place;
            return;
        }
        const { result } = this.response;
        if (!result) return;
        this.orbitAsked = this.wire.ask("orbit", { response: result.id, branch: place.branch, point: place.point }) !== 0;
        this.clicked = performance.now();
        this.mark();
    }

    private takeOrbit(frame: Frame): void {
        this.orbitAsked = false;
        if (frame.head.stage === "done") {
            this.hears.orbit(frame);
            const since = this.clicked;
            requestAnimationFrame(() => performance.measure("click-to-orbit", { start: since }));
        }
        const next = this.orbitWaiting;
        this.orbitWaiting = undefined;
        if (next) this.orbit(next);
        this.mark();
    }

    /** Starts or stops a sweep. */
    sweep(button: HTMLElement): void {
        const { view } = this.axes;
        if (this.sweeping) this.wire.ask("stop", { what: "sweep" });
        else if (view) {
            this.response.swept = [];
            this.wire.ask("sweep", { set: this.design.pairs, ...view, points: SWEEP_POINTS });
        }
        this.sweeping = !this.sweeping;
        button.textContent = this.sweeping ? "Stop" : "Sweep";
    }

    private takeSwept(head: Head): void {
        if (head.stage === "point") {
            this.response.swept.push({ x: head.x, up: head.up, values: { power: head.power, voltage: head.voltage, penetration: head.penetration } });
            this.response.draw();
            this.hears.say(`${head.index + 1} of ${head.of} values computed`);
            return;
        }
        this.sweeping = false;
        document.getElementById("sweep")!.textContent = "Sweep";
        this.hears.say(head.stage === "fault" ? head.faults[0]?.message : "sweep finished");
    }

    private patience(): void {
        this.pump();
        if (this.coarseAsked && performance.now() - this.asked > PATIENCE_MS) {
            this.busy.textContent = `computing, ${((performance.now() - this.asked) / 1000).toFixed(1)} s`;
        }
    }
}

function found(branches: number, ms: number): string {
    if (branches === 0) return "no branch of periodic orbits was found in this range; use Sweep to integrate over it";
    return `${branches} ${branches === 1 ? "branch" : "branches"}, ${Math.round(ms)} ms`;
}
