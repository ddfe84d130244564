// The engine in a thread of its own. The compiler's own script (dist/engine.js) stands before this one and makes
// `railstrata_engine`.
import type {FromWorker, ToWorker} from "./types";

interface FileSystem {
  mkdirTree(path: string): void;
  writeFile(path: string, text: string): void;
  chdir(path: string): void;
}
interface Engine {
  FS: FileSystem;
  HEAPF32: Float32Array;
  _malloc(bytes: number): number;
  _free(place: number): void;
  _rs_explore(request: number): number;
  _rs_explore_numbers(): number;
  _rs_explore_count(): number;
  lengthBytesUTF8(text: string): number;
  stringToUTF8(text: string, place: number, most: number): void;
  UTF8ToString(place: number): string;
}
declare function railstrata_engine(options: Record<string, unknown>): Promise<Engine>;

const post = (message: FromWorker, moved: Transferable[] = []) =>
    (self as unknown as {postMessage(m: FromWorker, t: Transferable[]): void}).postMessage(message, moved);

let engine: Engine|null = null;
let folder = "/";

function write(name: string, text: string): void {
  const path = `${folder}/${name}`;
  engine!.FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
  engine!.FS.writeFile(path, text);
}

function solve(request: string): void {
  const e = engine!;
  const bytes = e.lengthBytesUTF8(request) + 1;
  const place = e._malloc(bytes);
  e.stringToUTF8(request, place, bytes);
  const head = e.UTF8ToString(e._rs_explore(place));
  e._free(place);
  const first = e._rs_explore_numbers() / 4;
  const numbers = e.HEAPF32.slice(first, first + e._rs_explore_count());
  post({kind: "answer", head, numbers, memory: e.HEAPF32.byteLength}, [numbers.buffer]);
}

async function take(message: ToWorker): Promise<void> {
  if (message.kind === "start") {
    engine = await railstrata_engine({wasmBinary: message.wasm, print: () => {}, printErr: () => {}});
    folder = message.folder;
    engine.FS.mkdirTree(folder);
    engine.FS.chdir(folder);
    for (const [name, text] of Object.entries(message.files)) write(name, text);
    post({kind: "ready"});
  } else if (message.kind === "file") {
    write(message.name, message.text);
  } else {
    solve(JSON.stringify(message.request));
  }
}

self.onmessage = (event: MessageEvent<ToWorker>) => {
  take(event.data).catch((fault: unknown) => post({kind: "failed", message: String(fault)}));
};
