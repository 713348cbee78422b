/** Files that were dropped on the page, kept by this browser so that a reload finds them. They are not sent anywhere else. */

export interface TextFile {
  name: string;
  text: string;
  /** Its encoding, where nothing in the file proves it. */
  encoding?: string;
}

export interface KeptFile {
  name: string;
  bytes: number;
}

interface Row extends TextFile {
  /** Folder and name: every folder has its own. */
  key: string;
  folder: string;
  bytes: number;
  at_ms: number;
}

/** The oldest go first. */
export const MOST_FILES = 8;
export const MOST_BYTES = 100e6;

const STORE = "files";

function opened(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open("trueaxis", 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE, { keyPath: "key" });
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/** Runs one request on the store. */
async function ask<T>(mode: IDBTransactionMode, run: (store: IDBObjectStore) => IDBRequest<T>): Promise<T> {
  const database = await opened();
  try {
    return await new Promise((resolve, reject) => {
      const transaction = database.transaction(STORE, mode);
      const request = run(transaction.objectStore(STORE));
      transaction.oncomplete = () => resolve(request.result);
      transaction.onabort = transaction.onerror = () => reject(transaction.error);
    });
  } finally {
    database.close();
  }
}

const rows = async (folder: string): Promise<Row[]> => {
  const all = (await ask("readonly", (store) => store.getAll())) as Row[];
  return all.filter((row) => row.folder === folder).sort((a, b) => b.at_ms - a.at_ms);
};

/** A browser that keeps nothing (a private window) is no failure: the file is there until the page is closed. */
export async function keepFile(folder: string, file: TextFile): Promise<void> {
  try {
    const key = `${folder}\n${file.name}`;
    const row: Row = { ...file, key, folder, bytes: new Blob([file.text]).size, at_ms: Date.now() };
    if (row.bytes > MOST_BYTES) return;
    await ask("readwrite", (store) => store.put(row));
    let sum = 0;
    for (const [i, one] of (await rows(folder)).entries()) {
      sum += one.bytes;
      if (i >= MOST_FILES || sum > MOST_BYTES) await ask("readwrite", (store) => store.delete(one.key));
    }
  } catch {
    // why: see above.
  }
}

export async function keptFile(folder: string, name: string): Promise<TextFile | null> {
  try {
    const row = (await ask("readonly", (store) => store.get(`${folder}\n${name}`))) as Row | undefined;
    if (!row) return null;
    const { text, encoding } = row;
    return { name, text, ...(encoding ? { encoding } : {}) };
  } catch {
    return null;
  }
}

/** The latest first. */
export async function keptFiles(folder: string): Promise<KeptFile[]> {
  try {
    return (await rows(folder)).map(({ name, bytes }) => ({ name, bytes }));
  } catch {
    return [];
  }
}

export async function removeFile(folder: string, name: string): Promise<void> {
  await ask("readwrite", (store) => store.delete(`${folder}\n${name}`)).catch(() => undefined);
}
