// Bundles src/ into dist/: explore.js, explore.css and worker.js (the engine's own script, dist/engine.js, and the
// worker behind it), and sources.json by which a test sees that dist/ is up to date. The engine itself comes from
// build_engine.py.
import {build} from "esbuild";
import {createHash} from "node:crypto";
import {readdirSync, readFileSync, writeFileSync} from "node:fs";

const options = {bundle: true, minify: true, format: "iife", target: ["chrome109", "firefox115", "safari16"],
                 legalComments: "none", charset: "utf8"};
await build({...options, entryPoints: {explore: "src/main.ts"}, outdir: "dist"});
await build({entryPoints: {explore: "src/explore.css"}, outdir: "dist", minify: true, charset: "utf8"});
const worker = await build({...options, entryPoints: ["src/worker.ts"], write: false});
const glue = readFileSync("dist/engine.js", "utf8");
writeFileSync("dist/worker.js", `${glue}\n${worker.outputFiles[0].text}`);

// The closing tag of a script must not occur inside one.
for (const file of ["explore.js", "worker.js"])
  if (/<\/script|<!--/i.test(readFileSync(`dist/${file}`, "utf8")))
    throw new Error(`dist/${file} holds a text that would end its script element`);

const sha256 = (file) => createHash("sha256").update(readFileSync(file)).digest("hex");
const engine = JSON.parse(readFileSync("dist/engine_sources.json", "utf8"));
const page = ["package.json", "package-lock.json", "tsconfig.json", "build.mjs",
              ...readdirSync("src").sort().map((file) => `src/${file}`)].map((file) => `explore/${file}`);
const made = ["engine.js", "engine.wasm.gz", "LICENSES.txt", "explore.js", "explore.css", "worker.js"]
    .map((file) => `explore/dist/${file}`);
const hashes = Object.fromEntries([...page, ...made].map((file) => [file, sha256(`../${file}`)]));
writeFileSync("dist/sources.json", JSON.stringify({engine, page: hashes}, null, 2) + "\n");
