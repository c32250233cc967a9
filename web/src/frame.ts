// Responses of the server: a head in JSON and arrays of Float64, see crates/jounce-explorer/src/lib.rs.

export interface Fault {
    key: string;
    line: number;
    message: string;
}

// The head differs between responses; each module reads its own part.
// eslint-disable-next-line @typescript-eslint/no-explicit-any
export type Head = Record<string, any> & { id: number; ask: string; stage: string };

export class Frame {
    readonly head: Head;
    private readonly arrays = new Map<string, Float64Array>();

    constructor(bytes: ArrayBuffer) {
        const length = new DataView(bytes).getUint32(0, true);
        this.head = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
        for (const [name, first, count] of this.head.arrays as [string, number, number][]) {
            this.arrays.set(name, new Float64Array(bytes, 4 + length + 8 * first, count));
        }
    }

    /** An array of the response; empty where it has no array of that name. */
    array(name: string): Float64Array {
        return this.arrays.get(name) ?? new Float64Array(0);
    }

    has(name: string): boolean {
        return this.arrays.has(name);
    }
}
