// The ring on a curve: the point whose orbit is shown. It is that of the operating point, or of an orbit that the user has selected; the server finds its place on the curves by the motion of the orbit.

import { type Place, type ResponseResult, stablePlace } from "./branches";
import type { Head } from "./frame";
import type { OperatingPoint } from "./operating";
import { type OrbitIdentity, identityOf, identityText, readIdentity } from "./orbit-identity";
import type { Response } from "./response";
import type { AttractorPlace, BranchPlace, OrbitSource } from "./shown-orbit";
import type { Wire } from "./wire";

export class Selection {
    /** Point of the orbit of the operating point on the shown response; undefined where no branch is known to have it. */
    operating: Place | undefined;
    /** The selected attractor of the basins. */
    private picked: AttractorPlace | undefined;
    /** Identity of the selected orbit; undefined until it is computed. */
    private identity: OrbitIdentity | undefined;
    /** Response and orbits of the last request. */
    private result: ResponseResult | undefined;
    private requested = "";
    /** Number of the branch that had the ring of the operating point last. */
    private branch: number | undefined;
    /** Called with the point of the orbit of a link. */
    private opened: ((place: BranchPlace | undefined) => void) | undefined;
    /** Called when the point of the operating point is known. */
    onOperating: () => void = () => {};
    /** Called with the point of the selected orbit on a new response. */
    onMove: (place: BranchPlace) => void = () => {};

    constructor(private readonly wire: Wire, private readonly response: Response, private readonly point: OperatingPoint) {
        wire.on("branch-points", ({ head }) => this.take(head));
    }

    /** Selects the operating point. */
    followOperating(): void {
        this.drop();
        this.response.following = true;
        this.follow();
    }

    /** Registers the point of a curve that the user has selected. */
    chosen(): void {
        this.drop();
        this.follow();
    }

    /** Selects the orbit of an attractor of the basins. */
    pick(place: AttractorPlace): void {
        this.drop();
        this.picked = place;
        this.response.following = false;
        this.response.mark(undefined);
        this.follow();
    }

    /** Takes the orbit in the panel: that of the selected point has its identity now. */
    computed(head: Head, { place }: OrbitSource): void {
        const { chosen, chosenParameter, following, result } = this.response;
        if (following || this.identity || !result) return;
        const isPicked = JSON.stringify(place) === JSON.stringify(this.picked);
        const isChosen = chosen !== undefined && "branch" in place && place.response === result.id && place.branch === chosen.branch && place.point === chosen.point;
        const at = chosenParameter ?? (chosen && result.branches[chosen.branch].x[chosen.point]) ?? this.response.at;
        if ((isPicked || isChosen) && at !== undefined) this.identity = identityOf(head, at);
        this.follow();
    }

    /** The selected orbit as text; "" for that of the operating point. */
    get text(): string {
        return !this.response.following && this.response.chosen && this.identity ? identityText(this.identity) : "";
    }

    /** Selects the orbit of a text on the shown response; returns a message where it has none. */
    async open(text: string): Promise<string | undefined> {
        const identity = readIdentity(text);
        this.drop();
        const place = identity && await new Promise<BranchPlace | undefined>((opened) => {
            this.identity = identity;
            this.response.following = false;
            this.response.mark(undefined);
            this.opened = opened;
            this.follow();
        });
        if (place) return undefined;
        if (!this.response.chosen) this.followOperating();
        return `the link selects the orbit "${text}", which this response does not have`;
    }

    /** Places the ring on the shown response, and requests the points that are not known. */
    follow(): void {
        const { response, point } = this;
        const { chosen, following, result } = response;
        const orbits = [point.place ?? null, (!following && !chosen && (this.identity ?? this.picked)) || null];
        const requested = JSON.stringify(orbits);
        if (result !== this.result || requested !== this.requested) {
            this.operating = undefined;
            [this.result, this.requested] = [result, requested];
            const isSought = result !== undefined && result.branches.length > 0 && orbits.some((orbit) => orbit !== null);
            this.wait(isSought && this.wire.ask("branch-points", { response: result.id, orbits }) !== 0);
            if (!isSought) this.found([]);
        } else this.show();
    }

    /** The lost connection has taken the request with it. */
    forget(): void {
        this.requested = "";
        this.wait(false);
    }

    private drop(): void {
        const { opened } = this;
        this.picked = this.identity = this.opened = undefined;
        opened?.(undefined);
    }

    private wait(waits: boolean): void {
        document.getElementById("response-view")!.ariaBusy = String(waits);
    }

    private take({ stage, places }: Head): void {
        // A newer response has a request of its own.
        if (this.result !== this.response.result) return;
        this.found(stage === "done" ? places : []);
        this.wait(false);
    }

    private found([operating, selected]: (BranchPlace | null)[]): void {
        const { opened, response } = this;
        this.operating = operating ?? undefined;
        if (!response.following && !response.chosen && selected) {
            response.mark(selected, selected.parameter);
            this.onMove(selected);
        }
        this.opened = undefined;
        opened?.(selected ?? undefined);
        this.show();
        this.onOperating();
    }

    /** Draws the ring at the operating point. Until its attractor is known the panel shows a stable orbit of the branch that had the ring, or of the largest power. */
    private show(): void {
        const { point, response } = this;
        const { at, following, result } = response;
        if (!following || !result) return response.draw();
        response.mark(point.attractor || at === undefined ? this.operating : stablePlace(result, at, this.branch));
        if (response.chosen) this.branch = result.branches[response.chosen.branch].identity;
    }
}
