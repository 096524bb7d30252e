// What the page was made with: a JSON text in the document, arrays in it packed (view/blobs.py).

export function readDocument() {
    return JSON.parse(document.getElementById("patina-data").textContent);
}

const types = { u1: Uint8Array, u2: Uint16Array, f2: Uint16Array, u4: Uint32Array, f4: Float32Array };

export async function unpack(text, type) {
    const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new types[type](await new Response(stream).arrayBuffer());
}
