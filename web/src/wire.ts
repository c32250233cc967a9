// The socket: sends requests, distributes responses, reconnects when the server returns.

import { Frame } from "./frame";

type Hear = (frame: Frame) => void;

const RETRY_MS = 700;

export class Wire {
    private socket: WebSocket | undefined;
    private next = 1;
    private readonly heard = new Map<string, Hear>();
    /** Number of the last request of each kind: older responses are ignored. */
    private readonly last = new Map<string, number>();
    onOpen: () => void = () => {};
    /** Called with true where the server runs but accepts no further page. */
    onLost: (full: boolean) => void = () => {};

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

    /** Registers the handler of responses of one kind, including the faults of that kind. */
    on(ask: string, hear: Hear): void {
        this.heard.set(ask, hear);
    }

    /** Sends a request and returns its number, or 0 without a connection. */
    ask(ask: string, body: object): number {
        if (this.socket?.readyState !== WebSocket.OPEN) return 0;
        const id = this.next++;
        this.last.set(ask, id);
        this.socket.send(JSON.stringify({ id, ask, ...body }));
        return id;
    }

    private take(frame: Frame): void {
        const { id, ask } = frame.head;
        if (id !== 0 && id !== this.last.get(ask)) return;
        this.heard.get(ask)?.(frame);
    }
}
