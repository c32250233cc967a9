// Order of requests: one coarse response is computed at a time, only the newest position waits for it, older ones are dropped.

import type { ResponseResult } from "./branches";
import type { Axes } from "./axes";
import type { Design } from "./design";
import type { Fault, Frame, Head } from "./frame";
import type { Response } from "./response";
import type { OrbitSource } from "./shown-orbit";
import type { Request, Wire } from "./wire";

interface Hears {
    say: (words: string) => void;
    /** A response, from which the orbit to show may follow. */
    response: () => void;
    orbit: (frame: Frame, of: OrbitSource) => void;
    fault: (source: string, faults: Fault[]) => void;
    /** Room for the drawing. */
    room: () => object;
}

/** Time without a response after which the page shows that it computes. */
const PATIENCE_MS = 333;
/** Time after which a newer position cancels the computation of an older one. */
const STALE_MS = 4000;
const SWEEP_POINTS = 61;
/** Stages of a response, in their order. */
const STAGES = ["first", "coarse", "fine"];

export class Requests {
    /** Times of changes that are not requested yet. */
    private designWaits: number | undefined;
    private waiting: number | undefined;
    private designAsked = false;
    private coarseAsked = false;
    private asked = 0;
    private since = 0;
    private orbitAsked = false;
    /** Design, without the key of the axis, and view of the last response. */
    private requested = "";
    private requestedOrbit: OrbitSource | undefined;
    /** Stage that the last response with a fault had reached. */
    private failedAfter = -1;
    private stage = -1;
    private clicked = 0;
    private orbitWaiting: OrbitSource | undefined;
    /** Called once no orbit is computed. */
    private afterOrbit: (() => void) | undefined;
    private sweeping = false;
    /** True where the drives have a common period, so that there are periodic orbits. */
    private periodic: boolean | undefined;
    /** True while a fine response is expected. */
    private refining = false;
    private readonly busy = document.getElementById("busy")!;

    constructor(private readonly wire: Wire, private readonly design: Design, private readonly axes: Axes, private readonly response: Response, private readonly hears: Hears) {
        wire.on("orbit", (frame) => this.takeOrbit(frame));
        wire.on("sweep", ({ head }, request) => this.takeSwept(head, request));
        document.getElementById("response-stop")!.onclick = () => this.stop();
        setInterval(() => this.patience(), 100);
    }

    /** Registers a change of the design at a time of `performance.now()`. */
    change(time: number): void {
        this.waiting = this.designWaits = time;
        this.pump();
    }

    /** Requests the drawing for another room. */
    redraw(): void {
        this.designWaits = performance.now();
        this.pump();
    }

    /** True where the searched response of the present design is shown. */
    get isResponseShown(): boolean {
        const { result, isOld } = this.response;
        return result !== undefined && !result.draft && !isOld && !this.refining && !this.coarseAsked && this.waiting === undefined;
    }

    /** Requests the response again where its range or the periods to search for have changed. */
    searchAgain(): void {
        this.waiting ??= performance.now();
        this.pump();
    }

    /** Waits with the response until the next design specifies the keys and the kind of drive. */
    forgetDesign(): void {
        this.periodic = undefined;
    }

    /** Clears all requests after the connection is lost. */
    forget(): void {
        this.designAsked = this.coarseAsked = this.refining = this.orbitAsked = this.sweeping = false;
        this.orbitWaiting = undefined;
        this.requested = "";
        document.getElementById("sweep")!.textContent = "Sweep";
        this.sayBusy("");
        this.mark();
    }

    private pump(): void {
        const set = this.design.pairs;
        if (this.designWaits !== undefined && !this.designAsked) {
            this.designWaits = undefined;
            this.designAsked = this.wire.ask("design", { set, ...this.hears.room() }) !== 0;
        }
        // A long computation is cancelled; a short one is completed, so that the curve follows a moving slider.
        const late = performance.now() - this.asked > STALE_MS;
        if (this.waiting !== undefined && this.periodic !== undefined && this.axes.view && (!this.coarseAsked || late)) {
            this.since = this.waiting;
            this.waiting = undefined;
            if (this.periodic && this.requested !== this.asks()) this.askResponse();
        }
        this.mark();
    }

    /** A response over a key does not depend on the value of the key itself. */
    private asks(): string {
        const { view } = this.axes;
        return JSON.stringify([view, view && this.design.signatureWithout(view.over), this.response.longestPeriod]);
    }

    private askResponse(): void {
        this.asked = performance.now();
        this.requested = this.asks();
        this.stage = -1;
        this.refining = this.coarseAsked = this.wire.ask("response", { set: this.design.pairs, ...this.axes.view, longest_period: this.response.longestPeriod }) !== 0;
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

    designTaken(periodic: boolean): void {
        this.designAsked = false;
        this.periodic = periodic;
        this.hears.fault("design", []);
        if (!periodic) this.hears.fault("response", []);
        // The first design specifies the range of the response.
        this.pump();
    }

    designFault(head: Head): void {
        this.designAsked = false;
        this.hears.fault("design", head.faults);
        this.pump();
    }

    responseFault(head: Head): void {
        this.coarseAsked = this.refining = false;
        this.sayBusy("");
        this.requested = "";
        this.failedAfter = Math.min(this.stage, STAGES.length - 2);
        this.hears.fault("response", head.faults);
        this.pump();
    }

    responseTaken(head: Head, result: ResponseResult): void {
        this.stage = STAGES.indexOf(head.stage);
        // A fault is gone once a response passes the stage at which it appeared.
        if (this.stage > this.failedAfter) {
            this.failedAfter = -1;
            this.hears.fault("response", []);
        }
        this.response.take(result);
        this.hears.response();
        if (head.stage === "first") return;
        if (head.stage === "coarse") {
            const since = this.since;
            // Measured to the frame that shows the branch, with the server's own time.
            requestAnimationFrame(() => performance.measure("slider-to-branch", { start: since, detail: head.ms }));
            this.coarseAsked = false;
            this.sayBusy(this.waiting === undefined ? "draft, searching" : "");
            this.pump();
        } else {
            this.sayBusy("");
            this.refining = false;
            this.mark();
            this.hears.say(found(result.branches.length, head.ms));
        }
    }

    /** Takes the progress of the search. */
    progress({ done, of }: Head): void {
        if (this.refining && !this.coarseAsked) this.sayBusy(`draft, searching: ${done} of ${of} parts`);
    }

    /** Ends the search; the draft remains. */
    private stop(): void {
        this.wire.stop("response");
        this.coarseAsked = this.refining = false;
        this.sayBusy("draft, search stopped", false);
        this.hears.say("search of branches stopped");
        this.mark();
    }

    private sayBusy(words: string, canStop = words !== ""): void {
        this.busy.textContent = words;
        document.getElementById("response-stop")!.hidden = !canStop;
    }

    /** Requests an orbit; the newest request waits for the running one. */
    orbit(of: OrbitSource | undefined): void {
        if (!of) return;
        if (this.orbitAsked) {
            this.orbitWaiting = of;
            return;
        }
        this.requestedOrbit = of;
        this.orbitAsked = this.wire.ask("orbit", of.place) !== 0;
        this.clicked = performance.now();
        this.mark();
    }

    /** Requests the shown orbit, or the one that is being computed, again: the server compares it with the attractors that it has found since. */
    compareAgain(shown: OrbitSource | undefined): void {
        this.orbit(this.orbitAsked ? this.orbitWaiting ?? this.requestedOrbit : shown);
    }

    /** Calls a function once the requested orbit is shown. */
    whenOrbitShown(run: () => void): void {
        if (this.orbitAsked) this.afterOrbit = run;
        else run();
    }

    private takeOrbit(frame: Frame): void {
        this.orbitAsked = false;
        if (frame.head.stage === "done") {
            this.hears.orbit(frame, this.requestedOrbit!);
            const since = this.clicked;
            requestAnimationFrame(() => performance.measure("click-to-orbit", { start: since }));
        } else if (frame.head.stage === "fault") {
            document.getElementById("orbit-title")!.textContent = `Orbit: ${frame.head.faults[0]?.message}`;
        }
        const next = this.orbitWaiting;
        this.orbitWaiting = undefined;
        if (next) this.orbit(next);
        else {
            this.afterOrbit?.();
            this.afterOrbit = undefined;
        }
        this.mark();
    }

    /** Starts or stops a sweep. */
    sweep(button: HTMLElement): void {
        const { view } = this.axes;
        if (this.sweeping) this.wire.stop("sweep");
        else if (view) {
            this.response.swept = [];
            this.wire.ask("sweep", { set: this.design.pairs, ...view, points: SWEEP_POINTS });
        }
        this.sweeping = !this.sweeping;
        button.textContent = this.sweeping ? "Stop" : "Sweep";
    }

    private takeSwept(head: Head, { design }: Request): void {
        if (head.stage === "point") {
            this.response.swept.push({ design, over: head.over, x: head.x, up: head.up, values: { power: head.power, voltage: head.voltage, penetration: head.penetration } });
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
            this.sayBusy(`computing, ${((performance.now() - this.asked) / 1000).toFixed(1)} s`);
        }
    }
}

function found(branches: number, ms: number): string {
    if (branches === 0) return "no branch of periodic orbits was found in this range; use Sweep to integrate over it";
    return `${branches} ${branches === 1 ? "branch" : "branches"}, ${Math.round(ms)} ms`;
}
