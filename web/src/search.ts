// Search for a better design: the sliders move to each better one as soon as it is found, next to the curves of the start.

import type { Controls } from "./controls";
import type { Design } from "./design";
import type { Frame, Head } from "./frame";
import { Outcome } from "./outcome";
import { Problem } from "./problem";
import type { Response } from "./response";
import type { FieldFault } from "./rows";
import { digits } from "./units";
import type { Wire } from "./wire";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Search {
    readonly problem: Problem;
    private readonly outcome: Outcome;
    private readonly run = find<HTMLButtonElement>("search-run");
    private readonly take = find<HTMLButtonElement>("search-take");
    private readonly back = find<HTMLButtonElement>("search-back");
    private readonly words = find("search-words");
    private running = false;
    /** Design at the start. */
    private start: [string, string][] = [];
    /** The last better design. */
    private best: Head | undefined;
    /** Signature of the design to which the search has moved the sliders. */
    private signature = "";
    /** True while the search itself changes the design. */
    private moving = false;
    private offered = false;

    constructor(private readonly wire: Wire, controls: Controls, private readonly design: Design, private readonly response: Response) {
        this.problem = new Problem(controls);
        this.outcome = new Outcome(find("search-result"), this.problem, controls);
        wire.on("design-offer", ({ head }) => (head.stage === "fault" ? this.problem.tell(head.faults) : this.problem.offer(head)));
        wire.on("design-search", (frame) => this.hear(frame));
        // Enter accepts a value, and the form itself has no address.
        find<HTMLFormElement>("search-form").onsubmit = (event) => event.preventDefault();
        this.run.onclick = () => (this.running ? this.stop("stopped") : this.begin());
        this.take.onclick = () => this.move(false);
        this.back.onclick = () => this.goBack();
    }

    /** Requests what the problem can have, once its tab is shown. */
    show(): void {
        if (!this.offered) this.offered = this.wire.ask("design-offer", { set: this.design.pairs }) !== 0;
        this.problem.offerKeys();
    }

    /** Ends a search whose design the user has changed, and shows whether its result is the present design. */
    mark(): void {
        if (this.moving) return;
        const isOwn = this.signature === "" || this.signature === this.design.signature;
        if (this.running && !isOwn) this.stop("stopped, because the design has changed");
        if (!isOwn) this.response.start = undefined;
        find("search-stale").hidden = isOwn || this.best === undefined;
    }

    /** Offers the keys of another design. */
    designTaken(): void {
        this.problem.offerKeys();
    }

    /** The file may have other patches and stops. */
    fileChanged(): void {
        this.offered = false;
    }

    /** The lost connection has taken the search with it. */
    forget(): void {
        this.offered = false;
        if (this.running) this.end("stopped, because the connection was lost");
    }

    private begin(): void {
        this.problem.tell([]);
        this.outcome.clear();
        this.start = this.design.pairs;
        this.best = undefined;
        this.signature = this.design.signature;
        this.response.start = this.response.isOld ? undefined : this.response.result;
        this.running = this.wire.ask("design-search", { set: this.start, ...this.problem.fields }) !== 0;
        if (this.running) this.words.textContent = "searching";
        this.showState();
    }

    private stop(reason: string): void {
        this.wire.stop("design-search");
        this.end(reason);
    }

    private end(reason: string): void {
        this.running = false;
        this.words.textContent = this.best ? `${reason}; this is the best design so far` : reason;
        if (this.best) this.outcome.showStopped(this.best);
        else this.response.start = undefined;
        this.response.draw();
        this.showState();
    }

    private hear({ head }: Frame): void {
        if (head.stage === "file") find("search-file").textContent = head.file;
        else if (head.stage === "progress") this.words.textContent = `${head.done} designs evaluated, ${digits(head.seconds, 2)} s${this.goal()}`;
        else if (head.stage === "better") {
            this.best = head;
            this.move(true);
        } else if (head.stage === "fault") {
            this.problem.tell(head.faults as FieldFault[]);
            this.end(this.best ? (head.faults as FieldFault[])[0]?.message : "not started");
            find("search-form").querySelector<HTMLElement>("[aria-invalid=true]")?.focus();
        } else {
            this.best = head;
            this.move(true);
            this.running = false;
            this.words.textContent = head.violation_text ? "finished; no design keeps all limits" : "finished";
            this.outcome.show(head);
            this.showState();
        }
    }

    /** The goal of the best design so far. */
    private goal(): string {
        const { best } = this;
        if (!best) return "";
        const value = this.problem.goalText(this.problem.goalName, best.goal);
        return best.violation > 0 ? "; no design keeps all limits yet" : `; ${this.problem.goalName.replaceAll("-", " ")} ${value}`;
    }

    /** Moves the sliders to the best design; undo returns to the design before, once it is taken. */
    private move(moving: boolean): void {
        if (!this.best) return;
        this.moving = true;
        this.design.setAll(this.best.shown as [string, string][], moving);
        this.moving = false;
        this.signature = this.design.signature;
        this.showState();
        this.mark();
    }

    private goBack(): void {
        if (this.running) this.stop("stopped");
        this.design.replace(this.start);
        this.response.start = undefined;
        this.response.draw();
    }

    private showState(): void {
        this.run.textContent = this.running ? "Stop" : "Start";
        this.take.disabled = this.running || this.best === undefined;
        this.back.disabled = this.best === undefined;
        this.words.ariaBusy = String(this.running);
    }
}
