/** A machine with the surfaces of its STL files, for the picture. */

import type { Api, Diagnostic, MachineDescription, Model, SurfaceModel } from "../api.ts";

export interface WithModels {
  machine: MachineDescription;
  /** What is wrong with the files. */
  diagnostics: Diagnostic[];
}

/** Asks for the surfaces only where a model comes from an STL file. `body` names the machine as other requests do. */
export async function withModels(
  api: Api,
  body: { machine: string; text?: string },
  machine: MachineDescription,
): Promise<WithModels> {
  if (!machine.models.some((model) => "stl" in model.shape)) return { machine, diagnostics: [] };
  const frame = await api.ask("models", body);
  const models = modelsOf(frame.header.models, frame.f32("corners_mm"));
  return { machine: { ...machine, models }, diagnostics: frame.header.diagnostics };
}

/** `corners`: 9 numbers per triangle, model after model. */
export function modelsOf(models: readonly SurfaceModel[], corners: Float32Array): Model[] {
  let at = 0;
  return models.map(({ triangles, ...model }) => {
    const from = at;
    at += 9 * triangles;
    return { ...model, shape: { mesh: corners.subarray(from, at) } };
  });
}
