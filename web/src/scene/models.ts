/** A machine with the surfaces of its STL files, for the picture. */

import type { Api, Diagnostic, MachineDescription, Model } from "../api.ts";

export interface WithModels {
  machine: MachineDescription;
  /** What is wrong with the files. */
  diagnostics: Diagnostic[];
}

/** Asks for the surfaces only where a model comes from an STL file. `body` names the machine as other requests do. */
export async function withModels(api: Api, body: { machine: string; text?: string }, machine: MachineDescription): Promise<WithModels> {
  if (!machine.models.some((model) => "stl" in model.shape)) return { machine, diagnostics: [] };
  const frame = await api.ask("models", body);
  const corners = frame.f32("corners_mm");
  let at = 0;
  const models = frame.header.models.map(({ name, body: index, placement, triangles }): Model => {
    const mesh = corners.subarray(at, (at += 9 * triangles));
    return { name, body: index, placement, shape: { mesh } };
  });
  return { machine: { ...machine, models }, diagnostics: frame.header.diagnostics };
}
