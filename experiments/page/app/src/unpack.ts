// The counterpart of experiments/page/packed_words.cpp.

async function gunzip(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function bytesOfBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** Puts the four planes of bytes together and undoes the differences to the word `stride` before. */
function wordsOfPlanes(planes: Uint8Array, stride: number): Uint32Array<ArrayBuffer> {
  const count = planes.length / 4;
  const words = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    const difference = planes[i]! | (planes[count + i]! << 8) | (planes[2 * count + i]! << 16) | (planes[3 * count + i]! << 24);
    words[i] = difference + (i < stride ? 0 : words[i - stride]!);
  }
  return words;
}

async function blobWords(number: number, stride: number): Promise<Uint32Array<ArrayBuffer>> {
  const text = document.getElementById(`blob-${number}`)?.textContent;
  if (!text) throw new Error(`the page holds no mesh data ${number}; was it cut short?`);
  return wordsOfPlanes(await gunzip(bytesOfBase64(text)), stride);
}

/** Resolves once the whole page, with the meshes at its end, has been read. */
export function pageIsRead(): Promise<void> {
  if (document.readyState !== "loading") return Promise.resolve();
  return new Promise((resolve) => document.addEventListener("DOMContentLoaded", () => resolve(), { once: true }));
}

export interface MeshArrays {
  positions: Float32Array; // x, y, z by vertex, Å from the middle of what is shown
  indices: Uint32Array; // three by triangle
}

export async function unpackMesh(positions: number, indices: number): Promise<MeshArrays> {
  await pageIsRead();
  const [coordinates, corners] = await Promise.all([blobWords(positions, 3), blobWords(indices, 1)]);
  return { positions: new Float32Array(coordinates.buffer), indices: corners };
}
