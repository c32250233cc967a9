// The orbit in the panel: whether it is that of the present design, and which attractors have it.

import type { Design } from "./design";
import type { Head } from "./frame";

/** An attractor of an operating point or of basins, named by the number of that result. */
export interface AttractorPlace {
    attractors: number;
    attractor: string;
}

/** A point of a response. */
export interface BranchPlace {
    response: number;
    branch: number;
    point: number;
    parameter?: number;
}

/** Where the orbit comes from that is requested or shown. */
export interface OrbitSource {
    place: BranchPlace | AttractorPlace;
    /** Value of the key of the response, with its unit. */
    at: string;
    /** Signature of its design. */
    design: string;
    /** Key whose value does not belong to the design of a response; empty for an attractor. */
    over: string;
}

export class ShownOrbit {
    private head: Head | undefined;
    /** The orbit that the panel shows; undefined where it shows words. */
    of: OrbitSource | undefined;

    constructor(private readonly design: Design) {}

    /** Registers the orbit that the panel shows; nothing where it shows words. */
    take(head?: Head, of?: OrbitSource): void {
        [this.head, this.of] = [head, of];
    }

    /** True where the panel shows the orbit of a place. */
    isOf(place: AttractorPlace): boolean {
        return JSON.stringify(this.of?.place) === JSON.stringify(place);
    }

    /** Id of the attractor, of those of a number and of the present design, whose orbit is shown: the server compares whole motions. */
    among(attractors: number): string | undefined {
        const { head, of } = this;
        if (!head || !of || this.design.isOld(of)) return undefined;
        return (head.attractors as AttractorPlace[]).find((own) => own.attractors === attractors)?.attractor;
    }
}
