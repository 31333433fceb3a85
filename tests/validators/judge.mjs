// judge.mjs glb|manifold|batch FILES: GLB files by the Khronos glTF validator and by their own numbers; OFF
// files and batches of meshes (mesh_batch.h) by the Manifold library, which accepts closed oriented meshes only.
// What is expected stands in NAME.expect (write_samples.cpp) or in the batch. Prints a line for each difference
// and exits with 1 if there is one.
import { readFileSync } from 'node:fs';

let differences = 0;
const report = (file, what) => { console.log(`${file}: ${what}`); ++differences; };

function expectation(file) {
  const expected = { metres: 0, objects: [] };
  for (const line of readFileSync(file.replace(/\.[^.]*$/, '.expect'), 'utf8').split('\n')) {
    const [kind, ...field] = line.split('\t');
    if (kind === 'unit') expected.metres = Number(field[0]);
    if (kind !== 'object') continue;
    const [name, triangles, volume, colored] = field;
    expected.objects.push({ name, triangles: Number(triangles), colored: colored === '1',
                            volume: volume === '-' ? null : Number(volume) });
  }
  return expected;
}

const close = (a, b) => Math.abs(a - b) <= 1e-6 * Math.abs(b);

/// Volume by the divergence theorem.
function volumeOf(position, index) {
  let sum = 0;
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => position.subarray(3 * index[i + k], 3 * index[i + k] + 3));
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

/// The JSON and a function that gives an accessor's numbers.
function parseGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const length = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
  const binary = bytes.slice(20 + length + 8);
  const width = { SCALAR: 1, VEC3: 3, VEC4: 4 };
  const type = { 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
  const numbers = (i) => {
    const a = json.accessors[i];
    return new type[a.componentType](binary.buffer, json.bufferViews[a.bufferView].byteOffset,
                                     a.count * width[a.type]);
  };
  return { json, numbers };
}

function judgeContent(file, bytes) {
  const expected = expectation(file);
  const { json, numbers } = parseGlb(bytes);
  const nodes = json.nodes ?? [];
  if (nodes.length !== expected.objects.length) report(file, `${nodes.length} nodes`);
  expected.objects.forEach((object, i) => {
    if ((nodes[i].name ?? '') !== object.name) report(file, `node ${i} is called ${nodes[i].name}`);
    const primitive = json.meshes[nodes[i].mesh].primitives[0];
    const index = numbers(primitive.indices);
    if (index.length !== 3 * object.triangles) report(file, `${index.length / 3} triangles`);
    if (('COLOR_0' in primitive.attributes) !== object.colored) report(file, `node ${i}: colors`);
    if (object.volume === null) return;
    const volume = volumeOf(numbers(primitive.attributes.POSITION), index);
    const wanted = object.volume * expected.metres ** 3;
    if (!(Math.abs(volume - wanted) <= 1e-5 * wanted)) report(file, `${volume} cubic metres, not ${wanted}`);
  });
}

async function judgeGlb(files) {
  const { default: validator } = await import('gltf-validator');
  for (const file of files) {
    const bytes = new Uint8Array(readFileSync(file));
    const { issues } = await validator.validateBytes(bytes, { uri: file, maxIssues: 20 });
    for (const m of issues.messages) report(file, `${m.code} at ${m.pointer}: ${m.message}`);
    judgeContent(file, bytes);
  }
}

function parseOff(text) {
  const lines = text.split('\n');
  const [vertices, triangles] = lines[1].split(' ').map(Number);
  const row = (i) => lines[2 + i].split(' ').map(Number);
  const position = new Float32Array(3 * vertices);
  const index = new Uint32Array(3 * triangles);
  for (let i = 0; i < vertices; ++i) position.set(row(i).slice(0, 3), 3 * i);
  for (let i = 0; i < triangles; ++i) index.set(row(vertices + i).slice(1, 4), 3 * i);
  return { position, index };
}

async function loadManifold() {
  const { default: load } = await import('manifold-3d');
  const library = await load();
  library.setup();
  return library;
}

async function judgeManifold(files) {
  const library = await loadManifold();
  for (const file of files) {
    const { position, index } = parseOff(readFileSync(file, 'utf8'));
    const closed = expectation(file).objects.every((object) => object.volume !== null);
    let solid = null;
    try {
      solid = new library.Manifold(new library.Mesh({ numProp: 3, vertProperties: position, triVerts: index }));
    } catch (error) {
      if (closed) report(file, `no manifold: ${error.message ?? error}`);
      continue;
    }
    if (!closed) { report(file, 'an open mesh is taken for a manifold'); continue; }
    const wanted = expectation(file).objects.reduce((sum, object) => sum + object.volume, 0);
    if (!close(solid.volume(), wanted)) report(file, `volume ${solid.volume()}, not ${wanted}`);
  }
}

/// The meshes of a batch, one after the other.
function* meshesOf(file) {
  const bytes = readFileSync(file);
  for (let at = 0; at < bytes.length;) {
    const end = bytes.indexOf(10, at);
    const [word, name, expected, volume, vertices, triangles] = bytes.toString('latin1', at, end).split(' ');
    if (word !== 'mesh') throw new Error(`${file} is no batch`);
    const numbers = (Type, count, from) =>
      new Type(bytes.buffer.slice(bytes.byteOffset + from, bytes.byteOffset + from + 4 * count));
    const corners = end + 1 + 12 * Number(vertices);
    at = corners + 12 * Number(triangles);
    yield { name, expected, volume: volume === '-' ? null : Number(volume),
            position: numbers(Float32Array, 3 * vertices, end + 1),
            index: numbers(Uint32Array, 3 * triangles, corners) };
  }
}

/// Manifold parts pinched vertices and does not look for crossings: no faults for it.
async function judgeBatch(files) {
  const library = await loadManifold();
  for (const file of files) {
    const count = { sound: 0, refused: 0, measured: 0 };
    for (const { name, expected, volume, position, index } of meshesOf(file)) {
      if (index.length === 0) continue;  // it refuses a mesh of nothing
      let found = null;
      try {
        const solid = new library.Manifold(new library.Mesh({ numProp: 3, vertProperties: position, triVerts: index }));
        found = solid.volume();
        solid.delete();
        ++count.sound;
      } catch (error) {
        ++count.refused;
      }
      const wanted = expected !== 'open' && expected !== 'misoriented';
      if ((found !== null) !== wanted) report(name, found === null ? 'no manifold' : `${expected}, but accepted`);
      if (found === null || volume === null) continue;
      ++count.measured;
      if (!(Math.abs(found - volume) <= 0.02 * volume + 1e-4)) report(name, `volume ${found}, not ${volume}`);
    }
    if (count.refused < 2 || count.measured === 0) report(file, 'is no batch with faults and volumes');
    console.log(`Manifold: ${count.sound} accepted, ${count.refused} refused, ${count.measured} volumes`);
  }
}

const judges = { glb: judgeGlb, manifold: judgeManifold, batch: judgeBatch };
const [kind, ...files] = process.argv.slice(2);
await judges[kind](files);
console.log(`${kind}: ${files.length} files, ${differences} differences`);
process.exit(files.length > 0 && differences === 0 ? 0 : 1);
