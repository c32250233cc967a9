// The socket: sends requests, distributes responses, reconnects when the server returns.

import type { Design } from "./design";
import { Frame } from "./frame";

/** A request, which each response to it brings back. */
export interface Request {
    id: number;
    // eslint-disable-next-line @typescript-eslint/no-explicit-any
    body: Record<string, any>;
    /** Signature of the design when it was sent. */
    design: string;
}

type Hear = (frame: Frame, request: Request) => void;

/** Frames that the server sends without a request. */
const UNREQUESTED: Request = { id: 0, body: {}, design: "" };

const RETRY_MS = 700;

export class Wire {
    private socket: WebSocket | undefined;
    private next = 1;
    private readonly heard = new Map<string, Hear>();
    /** Last request of each kind: responses to older ones are ignored. */
    private readonly last = new Map<string, Request>();
    onOpen: () => void = () => {};
    /** Called with true where the server runs but accepts no further page. */
    onLost: (full: boolean) => void = () => {};

    constructor(private readonly design: Design) {}

    connect(): void {
        const address = new URL("socket", location.href);
        address.protocol = location.protocol.replace("http", "ws");
        address.hash = "";
        const socket = new WebSocket(address);
        socket.binaryType = "arraybuffer";
        socket.onopen = () => {
            this.socket = socket;
            this.onOpen();
        };
        socket.onmessage = (event) => this.take(new Frame(event.data as ArrayBuffer));
        socket.onclose = () => {
            const wasOpen = this.socket !== undefined;
            this.socket = undefined;
            // The browser does not say why a socket is refused; a server that still serves files has too many pages.
            if (wasOpen) this.onLost(false);
            else void fetch("icon.svg", { cache: "no-store" }).then((reply) => this.onLost(reply.ok), () => this.onLost(false));
            setTimeout(() => this.connect(), RETRY_MS);
        };
    }

    /** Registers the only handler of responses of one kind, including the faults of that kind. */
    on(ask: string, hear: Hear): void {
        if (this.heard.has(ask)) throw new Error(`the replies to ${ask} have a handler`);
        this.heard.set(ask, hear);
    }

    /** Sends a request and returns its number, or 0 without a connection. */
    ask(ask: string, body: object): number {
        if (this.socket?.readyState !== WebSocket.OPEN) return 0;
        const id = this.next++;
        this.last.set(ask, { id, body, design: this.design.signature });
        this.socket.send(JSON.stringify({ id, ask, ...body }));
        return id;
    }

    /** Ends the last request of a kind; responses that are already on their way are ignored. */
    stop(ask: string): void {
        this.last.delete(ask);
        this.ask("stop", { what: ask });
    }

    private take(frame: Frame): void {
        const { id, ask } = frame.head;
        const request = id === 0 ? UNREQUESTED : this.last.get(ask);
        if (request?.id === id) this.heard.get(ask)?.(frame, request);
    }
}
