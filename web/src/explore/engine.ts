// The engine's worker: one request at a time, and of those that wait only the newest.
import {embedded} from "../dom";
import type {Answer, Fault, FromWorker, Head, Request, Seed, ToWorker} from "./types";

export interface Listener {
  answer(answer: Answer): void;
  faults(faults: Fault[]): void;
  broken(message: string): void;
}

/// The module as it stands in the page: packed, in base64.
async function moduleBytes(): Promise<ArrayBuffer> {
  const text = atob(embedded("engine").trim());
  const packed = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const plain = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(plain).arrayBuffer();
}

export class Engine {
  private worker: Worker|null = null;
  private running: Request|null = null;
  private waiting: Request|null = null;
  private ready = false;
  private readonly files: Record<string, string>;
  /// Bytes of the engine's memory, and how often it has answered.
  memory = 0;
  answers = 0;

  constructor(private readonly seed: Seed, private readonly listener: Listener) {
    this.files = {...seed.files};
    this.start();
  }

  private start(): void {
    const address = URL.createObjectURL(new Blob([embedded("worker")], {type: "text/javascript"}));
    this.worker = new Worker(address);
    this.worker.onmessage = (event: MessageEvent<FromWorker>) => this.take(event.data);
    this.worker.onerror = (event) => this.fail(event.message);
    this.ready = false;
    const worker = this.worker;
    moduleBytes().then(
        (wasm) => worker.postMessage({kind: "start", wasm, folder: this.seed.folder, files: this.files}, [wasm]),
        (fault: unknown) => this.fail(String(fault)));
  }

  private send(message: ToWorker): void { this.worker?.postMessage(message); }

  /// A file beside the case, for requests from now on.
  put(name: string, text: string): void {
    this.files[name] = text;
    if (this.ready) this.send({kind: "file", name, text});
  }

  /// Takes the place of a request that waits.
  ask(request: Request): void {
    this.waiting = request;
    this.next();
  }

  /// Takes back a request that waits.
  forget(): void { this.waiting = null; }

  get busy(): boolean { return this.running !== null || this.waiting !== null; }

  private next(): void {
    if (!this.ready || this.running || !this.waiting) return;
    this.running = this.waiting;
    this.waiting = null;
    this.send({kind: "solve", request: this.running});
  }

  /// A worker that has failed is of no use any more: the next request has a new one.
  private fail(message: string): void {
    this.worker?.terminate();
    const never = !this.ready && this.answers === 0;
    this.running = this.waiting = null;
    this.listener.broken(message);
    if (!never) this.start();
  }

  private take(message: FromWorker): void {
    if (message.kind === "failed") return this.fail(message.message);
    if (message.kind === "ready") {
      this.ready = true;
      return this.next();
    }
    const request = this.running;
    this.running = null;
    this.memory = message.memory;
    ++this.answers;
    if (request) this.tell(request, message.head, message.numbers);
    this.next();
  }

  private tell(request: Request, text: string, numbers: Float32Array): void {
    const head = JSON.parse(text) as Head | {
      ok: false;
      faults: Fault[]
    };
    if (head.ok)
      this.listener.answer({head, numbers, request});
    else
      this.listener.faults(head.faults.map((f) => this.withoutFolder(f)));
  }

  /// The engine's folder is no place that the reader knows.
  private withoutFolder(f: Fault): Fault {
    const clean = (text: string) => text.split(`${this.seed.folder}/`).join("");
    return {where: clean(f.where), message: clean(f.message), remedy: clean(f.remedy)};
  }
}
