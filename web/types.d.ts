// Made by `npm run types` from docs/schemas; not edited by hand.

/**
 * The source of the uncertainties.
 */
export type SourceEntry =
  | string
  | {
      /**
       * Its name.
       */
      campaign: string;
      /**
       * How many readings.
       */
      readings: number;
      /**
       * How many terms were found.
       */
      terms: number;
      /**
       * How many terms were left out because the readings do not support them.
       */
      left_out: number;
      /**
       * The verdict of the identification.
       */
      verdict: string;
    };
/**
 * How the errors are compensated.
 */
export type CompensationEntry =
  | {
      kind: "program";
      /**
       * What of each pose: `position` or `position and orientation`.
       */
      scope: string;
      /**
       * The files of the compensation.
       */
      files: FileEntry[];
    }
  | {
      kind: "tables";
      /**
       * Their form.
       */
      target: string;
      /**
       * How many.
       */
      tables: number;
      /**
       * The files of the compensation.
       */
      files: FileEntry[];
    };
/**
 * The travel of an axis.
 */
export type TravelEntry = [number, number] | string;
/**
 * A table or an error that was left out.
 */
export type LeftOutEntry = {
  /**
   * Why.
   */
  reason: string;
} & (
  | {
      /**
       * The axis by whose position it would be read.
       */
      input: string;
      /**
       * The axis to which it would add.
       */
      output: string;
    }
  | {
      /**
       * Its ISO 230-1 name.
       */
      error: string;
    }
);
/**
 * A number, or numbers by name.
 */
export type Amount =
  | (number | null)
  | {
      [k: string]: number;
    };
/**
 * The shape of a model.
 */
export type ShapeEntry =
  | {
      stl: {
        /**
         * The file, relative to the machine file.
         */
        path: string;
        /**
         * The length of its unit, mm.
         */
        unit_mm: number;
      };
    }
  | {
      /**
       * @minItems 3
       * @maxItems 3
       */
      box: [number, number, number];
    }
  | {
      cone: {
        /**
         * Diameter at its base, mm.
         */
        base_diameter_mm: number;
        /**
         * Diameter at its top, mm.
         */
        top_diameter_mm: number;
        /**
         * Its length, mm.
         */
        length_mm: number;
      };
    }
  | {
      prism: {
        /**
         * Its outline in x and y, mm.
         */
        outline_mm: [number, number][];
        /**
         * Its length along z, mm.
         */
        length_mm: number;
      };
    };
/**
 * An evaluation of readings by a standard, with what it says of the machine file: `trueaxis/evaluate/1`.
 */
export type Evaluate = {
  /**
   * Which document this is.
   */
  schema: "trueaxis/evaluate/1";
  /**
   * The version of the program.
   */
  version: string;
  /**
   * The standard, such as `iso230-2`.
   */
  standard: string;
  /**
   * The file of the readings.
   */
  file: string;
  /**
   * The name of the measurement; null if none is stated.
   */
  name: string | null;
  /**
   * The machine; null if none is stated.
   */
  machine: string | null;
  /**
   * The axis; null if none is stated.
   */
  axis: string | null;
  /**
   * The instrument; null if none is stated.
   */
  instrument: string | null;
  /**
   * The date of the measurement; null if none is stated.
   */
  date: string | null;
  /**
   * The temperature; null if none is stated. Unit: °C.
   */
  temperature_degC: number | null;
  /**
   * Figures against their tolerances; null where none has one.
   */
  decisions: DecisionsEntry | null;
  /**
   * A circle as errors of the machine file; absent where no machine is named.
   */
  machine_errors?: MachineErrorsEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
} & (PositioningEntry | GeometricEntry | CircularEntry | DriftEntry | DiagonalsEntry | RotationEntry | ProbingEntry);
/**
 * A quantity of ISO 230-2, or the expanded uncertainties of all of them.
 */
export type QuantityEntry =
  | (number | null)
  | {
      [k: string]: number | null;
    };
/**
 * The state of a run.
 */
export type State = "off" | "arm" | "run" | "hold" | "ramp-down" | "latched";
/**
 * Why a run is in its state.
 */
export type Reason =
  | {
      kind: "not-asked";
    }
  | {
      kind: "follows";
    }
  | {
      kind: "limit";
    }
  | {
      kind: "link-lost";
      /**
       * What the connection says.
       */
      what: string;
    }
  | {
      kind: "emergency";
    }
  | {
      kind: "not-homed";
    }
  | {
      kind: "homed-again";
    }
  | {
      kind: "watchdog";
    }
  | {
      kind: "inhibited";
    }
  | {
      kind: "released";
    }
  | {
      kind: "mode";
    }
  | {
      kind: "sensor";
      /**
       * Its name.
       */
      sensor: string;
      /**
       * What is wrong.
       */
      what: string;
    }
  | {
      kind: "workpiece";
      /**
       * Its name.
       */
      sensor: string;
      /**
       * What is wrong.
       */
      what: string;
    }
  | {
      kind: "model";
      /**
       * What it says.
       */
      what: string;
    }
  | {
      kind: "setup";
      /**
       * Its number.
       */
      number: number;
    }
  | {
      kind: "not-finite";
    }
  | {
      kind: "jump";
    }
  | {
      kind: "write-refused";
    }
  | {
      kind: "journal";
    }
  | {
      kind: "foreign";
    }
  | {
      kind: "difference";
    }
  | {
      kind: "lost";
    };
/**
 * The check of a program, or why there is none.
 */
export type PlanProgramEntry =
  | {
      /**
       * Why.
       */
      missing: string;
    }
  | {
      /**
       * How long it runs, s.
       */
      duration_s: number;
      /**
       * Whether it has neither errors nor critical issues.
       */
      sound: boolean;
      /**
       * Errors of the program itself.
       */
      errors: string[];
      /**
       * Critical issues, such as collisions.
       */
      grave: string[];
      /**
       * Minor issues, such as lost time.
       */
      minor: string[];
    };
/**
 * One value, or those of a family (`iso`, `paper`) by their keys.
 */
export type Grouped =
  | IndexEntry
  | {
      [k: string]: IndexEntry;
    };
/**
 * One value, or those of a family (`iso`, `paper`) by their keys.
 */
export type Grouped2 =
  | PositionIndex
  | {
      [k: string]: PositionIndex;
    };
/**
 * How a verdict is coloured.
 */
export type Standing = "good" | "bad" | "open";
/**
 * What stands in a section.
 */
export type ShownItem =
  | {
      kind: "paragraph";
      /**
       * Its text.
       */
      text: string;
    }
  | {
      kind: "note";
      /**
       * Its text.
       */
      text: string;
    }
  | {
      kind: "list";
      /**
       * The lines.
       */
      lines: string[];
    }
  | {
      kind: "code";
      /**
       * The lines.
       */
      text: string;
    }
  | {
      kind: "table";
      /**
       * The headings with their units; empty for pairs of name and value.
       */
      headings: string[];
      /**
       * The cells, row by row.
       */
      rows: string[][];
      /**
       * The text below it; may be empty.
       */
      note: string;
    };
export type ServeCompensateTargets = ServeCompensateTargetsTargetEntry[];
/**
 * Which error is compensated.
 */
export type CompensatedError = "machine" | "comprehensive";
/**
 * A document of the command line with the problems of its input.
 */
export type Diagnosed = {
  /**
   * Which document this is.
   */
  schema: "trueaxis/evaluate/1";
  /**
   * The version of the program.
   */
  version: string;
  /**
   * The standard, such as `iso230-2`.
   */
  standard: string;
  /**
   * The file of the readings.
   */
  file: string;
  /**
   * The name of the measurement; null if none is stated.
   */
  name: string | null;
  /**
   * The machine; null if none is stated.
   */
  machine: string | null;
  /**
   * The axis; null if none is stated.
   */
  axis: string | null;
  /**
   * The instrument; null if none is stated.
   */
  instrument: string | null;
  /**
   * The date of the measurement; null if none is stated.
   */
  date: string | null;
  /**
   * The temperature; null if none is stated. Unit: °C.
   */
  temperature_degC: number | null;
  /**
   * Figures against their tolerances; null where none has one.
   */
  decisions: DecisionsEntry | null;
  /**
   * The problems found in the input.
   */
  diagnostics: DiagnosticEntry[];
} & (PositioningEntry | GeometricEntry | CircularEntry | DriftEntry | DiagonalsEntry | RotationEntry | ProbingEntry);
/**
 * A picture of a report.
 */
export type PictureEntry =
  | {
      kind: "scatter";
      /**
       * Its title.
       */
      title: string;
      /**
       * The text below it.
       */
      note: string;
      /**
       * The name of the x axis with its unit.
       */
      x: string;
      /**
       * The name of the y axis with its unit.
       */
      y: string;
      /**
       * Whether the y axis contains 0.
       */
      from_zero: boolean;
      /**
       * The series.
       */
      bands: BandEntry[];
      /**
       * A dashed line, as a part of `points`.
       *
       * @minItems 2
       * @maxItems 2
       */
      dashed: [number, number];
    }
  | {
      kind: "polar";
      /**
       * Its title.
       */
      title: string;
      /**
       * The text below it.
       */
      note: string;
      /**
       * The curves.
       */
      lines: PolarLineEntry[];
    };
/**
 * The check of a program, or why there is none.
 */
export type ServePlanProgramEntry =
  | {
      /**
       * Why.
       */
      missing: string;
    }
  | {
      /**
       * How long it runs, s.
       */
      duration_s: number;
      /**
       * Whether it has neither errors nor critical issues.
       */
      sound: boolean;
      /**
       * Errors of the program itself.
       */
      errors: string[];
      /**
       * Critical issues, such as collisions.
       */
      grave: string[];
      /**
       * Minor issues, such as lost time.
       */
      minor: string[];
    };
/**
 * A prediction.
 */
export type ServePredict =
  | (ServePredictPieceEntry & {
      kind: "test-piece";
    })
  | (HolesEntry & {
      kind: "holes";
    })
  | (DrawingEntry & {
      kind: "drawing";
    });
/**
 * The content of a file, by its ending and, for TOML, by its sections.
 */
export type FileKind =
  | "machine"
  | "study"
  | "campaign"
  | "program"
  | "readings"
  | "setup"
  | "cl"
  | "live"
  | "comparison"
  | "certificate"
  | "measured"
  | "blank"
  | "rtcp"
  | "heading"
  | "other";
/**
 * A command that has a report.
 */
export type Verb =
  | "predict"
  | "simulate"
  | "plan"
  | "identify"
  | "evaluate"
  | "verify"
  | "diff"
  | "history"
  | "certificate"
  | "laser"
  | "part"
  | "compensate-program"
  | "compensate-tables"
  | "compensate-adapt"
  | "rtcp";
/**
 * An issue over a stretch of the path.
 */
export type IssueEntry = {
  /**
   * `collision`, `near-miss`, `rapid-in-stock`, `gouged-part`, `over-travel`, `over-speed`, `slowed-down` or `rotary-flip`.
   */
  code: string;
  /**
   * Whether part or machine are in danger; other issues cost time only.
   */
  grave: boolean;
  /**
   * The issue in one sentence.
   */
  text: string;
  /**
   * The line where it begins.
   */
  line: number;
  /**
   * The program, an index into `programs`.
   */
  program: number;
  /**
   * The line where it ends.
   */
  last_line: number;
  /**
   * When it begins, s.
   */
  from_s: number;
  /**
   * When it ends, s.
   */
  to_s: number;
  /**
   * How many points of the path are in it.
   */
  nodes: number;
  /**
   * How many stretches it holds: above 1 where there are so many of its kind that the nearest were put together.
   */
  stretches: number;
} & (
  | {
      /**
       * The two bodies.
       *
       * @minItems 2
       * @maxItems 2
       */
      bodies: [string, string];
      /**
       * Their smallest distance, mm.
       */
      clearance_mm: number;
    }
  | {
      /**
       * The tool.
       */
      tool: number;
      /**
       * How deep it cuts into the part, mm.
       */
      depth_mm: number;
    }
  | {
      /**
       * The axis.
       */
      axis: string;
      /**
       * The worst value: a position in mm or degrees, or a speed in mm/s or degrees/s.
       */
      value: number;
      /**
       * The limit, in the same unit.
       */
      limit: number;
    }
  | {
      /**
       * The axis.
       */
      axis: string;
      /**
       * Lowest ratio of the actual feed to the programmed one.
       */
      feed_ratio: number;
    }
  | {
      /**
       * The axis.
       */
      axis: string;
      /**
       * By how much it turns, degrees.
       */
      turned_deg: number;
    }
);
/**
 * From one block to another.
 */
export type BlockStep = "next" | "previous";
/**
 * A quantity that colours a path.
 */
export type PathColour = "deviation" | "feed" | "load";
/**
 * What a window receives as text; answers with arrays are binary.
 */
export type ServeSocket =
  | {
      /**
       * The number of the request.
       */
      id: number;
      /**
       * The share that is done, 0 to 1.
       */
      progress: number;
    }
  | {
      /**
       * The number of the request.
       */
      id: number;
      /**
       * The document; its type depends on the request.
       */
      reply: {
        [k: string]: unknown;
      };
      /**
       * The files below the project folder that were read or looked for: where one of them changes, so may the answer.
       */
      files_read: string[];
    }
  | {
      /**
       * The number of the request; null if it could not be read.
       */
      id: number | null;
      /**
       * Why.
       */
      error: RefusalEntry;
      /**
       * The files below the project folder that were read or looked for.
       */
      files_read: string[];
    }
  | {
      /**
       * Which; without a path any file may have changed.
       */
      changed: ChangeEntry;
    };
/**
 * @minItems 10
 * @maxItems 10
 */
export type ServeStandards = [
  StandardEntry,
  StandardEntry,
  StandardEntry,
  StandardEntry,
  StandardEntry,
  StandardEntry,
  StandardEntry,
  StandardEntry,
  StandardEntry,
  StandardEntry
];
/**
 * What is verified.
 */
export type VerifiedSubject = "readings" | "diff" | "history" | "certificate" | "laser" | "part";
/**
 * The documents of `trueaxis verify`, for their schemas.
 */
export type VerifiedDocument =
  VerifyDocument | DiffDocument | HistoryDocument | CertificateDocument | BeforeAfterDocument | VerifyPartDocument;
/**
 * A prediction.
 */
export type ServeWhatIf =
  | (ServeWhatIfPieceEntry & {
      kind: "test-piece";
    })
  | (HolesEntry & {
      kind: "holes";
    })
  | (DrawingEntry & {
      kind: "drawing";
    });

/**
 * All documents by name.
 */
export interface Documents {
  "before-after": BeforeAfter;
  certificate: Certificate;
  check: Check;
  "compensate-adapt": CompensateAdapt;
  "compensate-program": CompensateProgram;
  "compensate-tables": CompensateTables;
  compensate: Compensate;
  description: Description;
  diagnostic: Diagnostic;
  diff: Diff;
  "evaluate-form": EvaluateForm;
  evaluate: Evaluate;
  "explain-list": ExplainList;
  explain: Explain;
  history: History;
  "identify-errors": IdentifyErrors;
  "identify-expansion": IdentifyExpansion;
  "identify-expansions": IdentifyExpansions;
  "identify-probe-programs": IdentifyProbePrograms;
  "identify-probe": IdentifyProbe;
  "identify-rtcp-programs": IdentifyRtcpPrograms;
  "identify-rtcp": IdentifyRtcp;
  "identify-surface": IdentifySurface;
  "identify-tables": IdentifyTables;
  "identify-thermal": IdentifyThermal;
  "identify-tools": IdentifyTools;
  "live-expect": LiveExpect;
  "live-part": LivePart;
  "live-status": LiveStatus;
  "measure-part": MeasurePart;
  measure: Measure;
  new: New;
  part: Part;
  "plan-probe-surface": PlanProbeSurface;
  "plan-tool-setting": PlanToolSetting;
  plan: Plan;
  "pose-rows": PoseRows;
  pose: Pose;
  post: Post;
  "predict-holes": PredictHoles;
  "predict-part": PredictPart;
  predict: Predict;
  refused: Refused;
  "serve-array": ServeArray;
  "serve-compensate-adapt-request": ServeCompensateAdaptRequest;
  "serve-compensate-adapt": ServeCompensateAdapt;
  "serve-compensate-program-request": ServeCompensateProgramRequest;
  "serve-compensate-program": ServeCompensateProgram;
  "serve-compensate-tables-request": ServeCompensateTablesRequest;
  "serve-compensate-tables": ServeCompensateTables;
  "serve-compensate-targets-request": ServeCompensateTargetsRequest;
  "serve-compensate-targets": ServeCompensateTargets;
  "serve-compensate-values-request": ServeCompensateValuesRequest;
  "serve-compensate-values": ServeCompensateValues;
  "serve-describe-request": ServeDescribeRequest;
  "serve-describe": ServeDescribe;
  "serve-evaluate-request": ServeEvaluateRequest;
  "serve-evaluate": ServeEvaluate;
  "serve-identify-request": ServeIdentifyRequest;
  "serve-identify": ServeIdentify;
  "serve-live-request": ServeLiveRequest;
  "serve-live": ServeLive;
  "serve-measure-check-request": ServeMeasureCheckRequest;
  "serve-measure-check": ServeMeasureCheck;
  "serve-measure-request": ServeMeasureRequest;
  "serve-measure-sheet-request": ServeMeasureSheetRequest;
  "serve-measure-sheet": ServeMeasureSheet;
  "serve-measure": ServeMeasure;
  "serve-models-request": ServeModelsRequest;
  "serve-models": ServeModels;
  "serve-new-machine-request": ServeNewMachineRequest;
  "serve-new-machine": ServeNewMachine;
  "serve-open-request": ServeOpenRequest;
  "serve-open": ServeOpen;
  "serve-plan-request": ServePlanRequest;
  "serve-plan": ServePlan;
  "serve-pose-request": ServePoseRequest;
  "serve-pose": ServePose;
  "serve-predict-request": ServePredictRequest;
  "serve-predict": ServePredict;
  "serve-project-request": ServeProjectRequest;
  "serve-project": ServeProject;
  "serve-readings-columns-request": ServeReadingsColumnsRequest;
  "serve-readings-columns": ServeReadingsColumns;
  "serve-readings-text-request": ServeReadingsTextRequest;
  "serve-readings-text": ServeReadingsText;
  "serve-refused": ServeRefused;
  "serve-report-request": ServeReportRequest;
  "serve-report": ServeReport;
  "serve-save-made-request": ServeSaveMadeRequest;
  "serve-save-made": ServeSaveMade;
  "serve-save-request": ServeSaveRequest;
  "serve-save": ServeSave;
  "serve-set-error-request": ServeSetErrorRequest;
  "serve-set-error": ServeSetError;
  "serve-simulate-request": ServeSimulateRequest;
  "serve-simulate": ServeSimulate;
  "serve-simulation-at-request": ServeSimulationAtRequest;
  "serve-simulation-at": ServeSimulationAt;
  "serve-simulation-block-request": ServeSimulationBlockRequest;
  "serve-simulation-block": ServeSimulationBlock;
  "serve-simulation-curves-request": ServeSimulationCurvesRequest;
  "serve-simulation-curves": ServeSimulationCurves;
  "serve-simulation-path-request": ServeSimulationPathRequest;
  "serve-simulation-path": ServeSimulationPath;
  "serve-simulation-source-request": ServeSimulationSourceRequest;
  "serve-simulation-source": ServeSimulationSource;
  "serve-simulation-stock-request": ServeSimulationStockRequest;
  "serve-simulation-stock": ServeSimulationStock;
  "serve-socket-request": ServeSocketRequest;
  "serve-socket": ServeSocket;
  "serve-standards-request": ServeStandardsRequest;
  "serve-standards": ServeStandards;
  "serve-trace-request": ServeTraceRequest;
  "serve-trace": ServeTrace;
  "serve-verify-request": ServeVerifyRequest;
  "serve-verify": ServeVerify;
  "serve-what-if-request": ServeWhatIfRequest;
  "serve-what-if": ServeWhatIf;
  simulate: Simulate;
  "solve-path": SolvePath;
  solve: Solve;
  study: Study;
  trace: Trace;
  "verify-part": VerifyPart;
  verify: Verify;
}
/**
 * Virtual lasers before and after compensation.
 */
export interface BeforeAfter {
  /**
   * Which document this is.
   */
  schema: "trueaxis/before-after/1";
  /**
   * Name of the campaign.
   */
  name: string;
  /**
   * Name of the machine file.
   */
  machine: string;
  /**
   * Name of the machine that was measured.
   */
  measured: string;
  /**
   * Seed of the random numbers; each compensation has the next one.
   */
  seed: number;
  /**
   * `values`, or `tables` of a control.
   */
  added_by: string;
  /**
   * The least increment of a value of a linear axis, µm.
   */
  increment_um: number;
  /**
   * The lasers.
   */
  lasers: LaserEntry[];
  /**
   * The readings, axis by axis.
   */
  curves: CurveEntry[];
  /**
   * The files that were written.
   */
  files: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A laser.
 */
export interface LaserEntry {
  /**
   * Its name in the campaign.
   */
  name: string;
  /**
   * What it is set to; null if it reads the machine alone.
   */
  material: MaterialEntry | null;
}
/**
 * The compensation of a material in a laser.
 */
export interface MaterialEntry {
  /**
   * Coefficient of expansion, 1e-6/K.
   */
  expansion_um_per_m_k: number;
  /**
   * Temperature of the material, °C.
   */
  celsius: number;
  /**
   * The sensor that it is read from; null if it was typed in.
   */
  sensor: string | null;
  /**
   * How much longer the material is than at 20 °C, µm/m.
   */
  share_um_per_m: number;
  /**
   * Standard uncertainty of that, µm/m.
   */
  u_um_per_m: number;
}
/**
 * One laser on one axis under one compensation.
 */
export interface CurveEntry {
  /**
   * The axis.
   */
  axis: string;
  /**
   * The laser.
   */
  laser: string;
  /**
   * The path.
   */
  path: string;
  /**
   * `none`, `machine` or `comprehensive`.
   */
  compensation: string;
  /**
   * The mean of the runs that is farthest from 0, with its sign, µm.
   */
  largest_um: number;
  /**
   * The target of it, mm.
   */
  at_mm: number;
  /**
   * Standard uncertainty of this reading, µm.
   */
  u_um: number;
  /**
   * Standard uncertainty of the error there by the machine file; null if it states none, µm.
   */
  file_u_um: number | null;
  /**
   * Their expanded uncertainties (k = 2), by the same keys.
   */
  U_um: {
    [k: string]: number | null;
  };
  /**
   * Every target.
   */
  targets: TargetEntry[];
  [k: string]: number | null;
}
/**
 * A target.
 */
export interface TargetEntry {
  /**
   * Its position, mm.
   */
  target_mm: number;
  /**
   * What was added to the command, mean of both directions, µm.
   */
  added_um: number;
  /**
   * Mean deviation, rising; null if it was not approached so, µm.
   */
  up_um: number | null;
  /**
   * Mean deviation, falling; null if it was not approached so, µm.
   */
  down_um: number | null;
}
/**
 * The certificate of a volumetric compensation.
 */
export interface Certificate {
  /**
   * Which document this is.
   */
  schema: "trueaxis/certificate/1";
  /**
   * The version of TrueAxis.
   */
  version: string;
  /**
   * The name of the study.
   */
  name: string;
  /**
   * `pass`, `fail` or `undecided`.
   */
  verdict: string;
  /**
   * The reason in one sentence.
   */
  reason: string;
  /**
   * Number, customer, place, instruments with their certificates; null where they are not stated.
   */
  certificate: CertificateHead | null;
  /**
   * The machine.
   */
  machine: MachineEntry;
  /**
   * Its identified errors.
   */
  errors: CertifiedErrorEntry[];
  /**
   * How they were determined.
   */
  determination: DeterminationEntry;
  /**
   * How they are compensated.
   */
  compensation: CompensationEntry;
  /**
   * How the compensation was put into the control.
   */
  application: ApplicationEntry;
  /**
   * The measurement with the compensation in effect, at poses that the determination did not use.
   */
  validation: ValidationEntry;
  /**
   * The prediction for the zone in which the certificate holds.
   */
  zone: ZoneEntry;
  /**
   * The decision.
   */
  decision: DecisionEntry;
  /**
   * Every file that was read.
   */
  inputs: FileEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The head of a certificate.
 */
export interface CertificateHead {
  /**
   * Its number.
   */
  number: string;
  /**
   * For whom; null if it is not stated.
   */
  customer: string | null;
  /**
   * The serial number of the machine; null if it is not stated.
   */
  machine_serial: string | null;
  /**
   * Who measured; null if it is not stated.
   */
  operator: string | null;
  /**
   * Where; null if it is not stated.
   */
  place: string | null;
  /**
   * The date of the certificate, as written.
   */
  date: string;
  /**
   * The instruments.
   */
  instruments: InstrumentUsed[];
}
/**
 * An instrument with its certificate.
 */
export interface InstrumentUsed {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its serial number; null if it is not stated.
   */
  serial: string | null;
  /**
   * The number of its certificate.
   */
  certificate: string;
  /**
   * When it was calibrated, as written.
   */
  calibrated: string;
  /**
   * Until when that is valid, as written; null if it is not stated.
   */
  valid_until: string | null;
  /**
   * Whether it is valid on the date of the certificate; null if no end is stated.
   */
  is_valid: boolean | null;
}
/**
 * A machine by its name.
 */
export interface MachineEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its kinematic chain from the workpiece to the tool.
   */
  chain: string;
}
/**
 * An identified error: `value_at_0_um`, its value at position 0 of its axis, and `u_um`, its largest standard
 * uncertainty, µm; `…_urad`, µrad, of an angle.
 */
export interface CertifiedErrorEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  [k: string]: number | null;
}
/**
 * How the errors were determined.
 */
export interface DeterminationEntry {
  /**
   * The method in words.
   */
  method: string;
  /**
   * The date, as written.
   */
  date: string;
  /**
   * Who measured.
   */
  by: string;
  /**
   * The instrument.
   */
  instrument: string;
  /**
   * Its calibration.
   */
  calibration: string;
  /**
   * The temperature. Unit: °C.
   */
  temperature_c: number;
  /**
   * Its standard uncertainty; null if it is not stated. Unit: K.
   */
  u_temperature_c: number | null;
  /**
   * The source of their uncertainties: `machine file`, or a campaign of measurements.
   */
  uncertainties_from: SourceEntry;
  /**
   * How many poses were used.
   */
  poses_used: number;
}
/**
 * A file with its hash.
 */
export interface FileEntry {
  /**
   * What it is.
   */
  role: string;
  /**
   * Its name, relative to the study.
   */
  name: string;
  /**
   * Its SHA-256, hexadecimal.
   */
  sha256: string;
}
/**
 * How the compensation was put into the control.
 */
export interface ApplicationEntry {
  /**
   * In words.
   */
  method: string | null;
  /**
   * The date, as written.
   */
  date: string | null;
  /**
   * Who did it.
   */
  by: string | null;
  /**
   * The folder with what the control has loaded; null if that was not compared.
   */
  loaded: string | null;
}
/**
 * The measurement with the compensation in effect.
 */
export interface ValidationEntry {
  /**
   * The method in words.
   */
  method: string;
  /**
   * The date, as written.
   */
  date: string;
  /**
   * Who measured.
   */
  by: string;
  /**
   * The instrument.
   */
  instrument: string;
  /**
   * Its calibration.
   */
  calibration: string;
  /**
   * The temperature. Unit: °C.
   */
  temperature_c: number;
  /**
   * Its standard uncertainty; null if it is not stated. Unit: K.
   */
  u_temperature_c: number | null;
  /**
   * Where the instrument was set to zero, mm and degrees; null if it was not.
   */
  zero: {
    [k: string]: number;
  } | null;
  /**
   * Standard uncertainty of one coordinate of a reading, µm.
   */
  u_um: number;
  /**
   * Expanded uncertainty U = k·u of one coordinate of a reading, µm.
   */
  expanded_um: number;
  /**
   * Root mean square of the tip deviation, µm.
   */
  rms_um: StatesEntry;
  /**
   * Largest tip deviation, µm.
   */
  largest_um: StatesEntry;
  /**
   * What was predicted.
   */
  predicted: PredictedEntry;
  /**
   * Whether readings and prediction agree.
   */
  agreement: StatesEntry2;
  /**
   * The poses.
   */
  poses: CertifiedPoseEntry[];
}
/**
 * A figure without and with the compensation.
 */
export interface StatesEntry {
  /**
   * Without the compensation.
   */
  before: number;
  /**
   * With it.
   */
  after: number;
}
/**
 * The prediction of the residual error at the poses of the validation.
 */
export interface PredictedEntry {
  /**
   * All poses together are below this with the probability `share`, µm.
   */
  largest_within_um: number;
  /**
   * Root mean square, µm.
   */
  rms_um: number;
  /**
   * The probability. Unit: 1.
   */
  share: number;
  /**
   * Monte Carlo samples.
   */
  samples: number;
  /**
   * Their random seed.
   */
  seed: number;
}
/**
 * A figure without and with the compensation.
 */
export interface StatesEntry2 {
  /**
   * Without the compensation.
   */
  before: AgreementEntry | null;
  /**
   * With it.
   */
  after: AgreementEntry | null;
}
/**
 * A χ² test of readings against the prediction.
 */
export interface AgreementEntry {
  /**
   * χ² of the readings. Unit: 1.
   */
  chi_square: number;
  /**
   * How many numbers.
   */
  numbers: number;
  /**
   * The value that chance exceeds once in a hundred times. Unit: 1.
   */
  limit: number;
  /**
   * Whether χ² is within it.
   */
  holds: boolean;
}
/**
 * A pose of the validation.
 */
export interface CertifiedPoseEntry {
  /**
   * Its line in the table of readings.
   */
  line: number;
  /**
   * The positions of the axes, mm and degrees.
   */
  at: {
    [k: string]: number;
  };
  /**
   * The side of approach by axis, +1 or −1, where it is stated.
   */
  approach: {
    [k: string]: number;
  };
  /**
   * Measured deviation of the tip without the compensation, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  before_um: [number, number, number];
  /**
   * With it, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  after_um: [number, number, number];
  /**
   * Predicted deviation of the tip without the compensation, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  predicted_before_um: [number, number, number];
  /**
   * With it, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  predicted_after_um: [number, number, number];
  /**
   * Expanded uncertainty of the prediction, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  expanded_predicted_um: [number, number, number];
  /**
   * Predicted deviation of the tool axis with the compensation, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  predicted_axis_urad: [number, number, number];
  /**
   * Its expanded uncertainty, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  expanded_axis_urad: [number, number, number];
  /**
   * Length of `before_um`, µm.
   */
  length_before_um: number;
  /**
   * Length of `after_um`, µm.
   */
  length_after_um: number;
  /**
   * The predicted length is below this with 95 %, µm.
   */
  predicted_within_um: number;
  /**
   * |measured − predicted| over its expanded uncertainty, of the worst coordinate.
   */
  E_n: StatesEntry;
  /**
   * `pass`, `fail` or `undecided`.
   */
  verdict: string;
}
/**
 * The prediction for the zone in which the certificate holds.
 */
export interface ZoneEntry {
  /**
   * The ends by axis, mm or degrees.
   */
  ends: {
    /**
     * @minItems 2
     * @maxItems 2
     */
    [k: string]: [number, number];
  };
  /**
   * How many poses were evaluated.
   */
  poses: number;
  /**
   * Root mean square of the tip deviation without the compensation, µm.
   */
  rms_before_um: number;
  /**
   * With it, µm.
   */
  rms_after_um: number;
  /**
   * The largest with its uncertainty, µm.
   */
  largest_um: number;
  /**
   * The positions of the axes there, mm and degrees.
   */
  at: {
    [k: string]: number;
  };
}
/**
 * The decision.
 */
export interface DecisionEntry {
  /**
   * The rule in words.
   */
  rule: string;
  /**
   * The limit of the tip deviation, µm.
   */
  limit_um: number;
  /**
   * The coverage factor k of U = k·u. Unit: 1.
   */
  coverage_factor: number;
  /**
   * How many poses pass.
   */
  pass: number;
  /**
   * How many fail.
   */
  fail: number;
  /**
   * How many are neither.
   */
  undecided: number;
}
/**
 * A machine file, checked.
 */
export interface Check {
  /**
   * Which document this is.
   */
  schema: "trueaxis/check/1";
  /**
   * Whether the file can be used, perhaps with warnings.
   */
  usable: boolean;
  /**
   * The name of the machine.
   */
  name?: string;
  /**
   * Its kinematic chain from the workpiece to the tool.
   */
  chain?: string;
  /**
   * Where its data are from.
   */
  source?: string;
  /**
   * Its axes in chain order.
   */
  axes?: AxisEntry[];
  /**
   * Its coordinate systems with all axes at 0, without errors.
   */
  frames?: FrameEntry[];
  /**
   * Limits of spindle and magazine; absent where the file states none.
   */
  equipment?: EquipmentEntry | null;
  /**
   * The names of its tools.
   */
  tools?: string[];
  /**
   * The ISO 230-1 names of the errors that are stated.
   */
  errors?: string[];
  /**
   * The measurements that the errors are from.
   */
  measured?: MeasurementEntry[];
  /**
   * What a prediction or a simulation would need in addition, in words.
   */
  lacks?: string[];
  /**
   * The problems of the file.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * An axis; its travel is `travel_mm` or `travel_deg`.
 */
export interface AxisEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * `tool` or `workpiece`.
   */
  carries: string;
  /**
   * Its direction in the machine frame, a unit vector. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  direction: [number, number, number];
  /**
   * +1 where a positive command moves the body along the direction, −1 against it (ISO 841). Unit: 1.
   */
  sense: number;
  [k: string]: TravelEntry | null;
}
/**
 * A coordinate system of the machine with all axes at 0, without errors, in the machine frame (SCS).
 */
export interface FrameEntry {
  /**
   * `SCS`: simulation space, the machine frame. `PCS`: part program, the workpiece frame without a work offset.
   * `NCS`: node, a body of the chain. `UCS`: model.
   */
  frame: string;
  /**
   * The body that it belongs to; `b` is the bed.
   */
  body: string;
  /**
   * The name of the model; absent for other frames.
   */
  model?: string | null;
  /**
   * Its origin.
   *
   * @minItems 3
   * @maxItems 3
   */
  origin_mm: [number, number, number];
  /**
   * Its x axis, a unit vector. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  x: [number, number, number];
  /**
   * Its y axis, a unit vector. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  y: [number, number, number];
  /**
   * Its z axis, a unit vector. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  z: [number, number, number];
}
/**
 * Spindle and magazine; null where the file does not state it.
 */
export interface EquipmentEntry {
  /**
   * Highest speed of the spindle, 1/min.
   */
  max_speed_per_min: number | null;
  /**
   * Lowest speed at which the spindle turns, 1/min.
   */
  min_speed_per_min: number | null;
  /**
   * Power of the spindle motor, kW.
   */
  spindle_power_kw: number | null;
  /**
   * Places of the magazine.
   */
  magazine_places: number | null;
}
/**
 * A measurement with the errors that it determined.
 */
export interface MeasurementEntry {
  /**
   * Instrument, date and temperature.
   */
  by: string;
  /**
   * The names of the errors.
   */
  errors: string[];
}
/**
 * A problem found in the input.
 */
export interface DiagnosticEntry {
  /**
   * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
   */
  code: string;
  /**
   * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
   */
  severity: string;
  /**
   * The file as the user named it, or an argument such as `--at`.
   */
  file: string;
  /**
   * The line, from 1; 0 for the file as a whole.
   */
  line: number;
  /**
   * The column in characters, from 1; 0 for the file as a whole.
   */
  column: number;
  /**
   * The problem in one sentence.
   */
  message: string;
  /**
   * What to do; empty if it follows from the message.
   */
  hint: string;
}
/**
 * A path moved onto a measured blank: `trueaxis/compensate-adapt/1`.
 */
export interface CompensateAdapt {
  /**
   * Which document this is.
   */
  schema: "trueaxis/compensate-adapt/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The file of the path.
   */
  path: string;
  /**
   * `good`, `not applied` (words of the path are not) or `not to be cut`.
   */
  verdict: string;
  /**
   * Words of the path that can change motion, spindle or coolant and are not applied; the exit status is then 1.
   */
  not_applied: number;
  /**
   * What speaks against the path.
   */
  findings: FindingEntry[];
  /**
   * How the blank lies.
   */
  registration: RegistrationEntry;
  /**
   * The form of the blank.
   */
  field: FieldEntry;
  /**
   * The places of the path.
   */
  places: PlacesEntry;
  /**
   * The wall that remains.
   */
  wall: WallEntry;
  /**
   * The wall place by place.
   */
  map: CellEntry[];
  /**
   * The program of the adapted path; null if none was asked for.
   */
  program: ProgramEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * What speaks against the path.
 */
export interface FindingEntry {
  /**
   * Its name for programs.
   */
  code: string;
  /**
   * The line of the path where it is worst.
   */
  line: number;
  /**
   * At how many places it is so.
   */
  places: number;
  /**
   * What was found.
   */
  message: string;
}
/**
 * How the blank lies, with standard uncertainties.
 */
export interface RegistrationEntry {
  /**
   * Which of its freedoms the path follows.
   */
  follow: string;
  /**
   * The point about which it turns, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  centre_mm: [number, number, number];
  /**
   * The shift, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  shift_um: [number, number, number];
  /**
   * Its standard uncertainty, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  u_shift_um: [number, number, number];
  /**
   * The turn, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  turn_urad: [number, number, number];
  /**
   * Its standard uncertainty, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  u_turn_urad: [number, number, number];
  /**
   * The freedoms that no reading determines, held at zero.
   */
  held: string[];
}
/**
 * The form of the blank as a smooth field.
 */
export interface FieldEntry {
  /**
   * How many points were probed.
   */
  points: number;
  /**
   * The length over which the form changes, mm.
   */
  length_mm: number;
  /**
   * The standard deviation of the form, µm.
   */
  form_um: number;
  /**
   * The standard deviation of a reading, µm.
   */
  noise_um: number;
  /**
   * The standard uncertainty that all readings share, in full part of that of the field, µm.
   */
  common_um: number;
  /**
   * Each point predicted by all others: root mean square of the difference, µm.
   */
  left_out_rms_um: number;
  /**
   * The share of these differences within U (k = 2). Unit: 1.
   */
  left_out_within_u2: number;
  /**
   * The factor by which the uncertainty was raised. Unit: 1.
   */
  raised: number;
  /**
   * Points that do not fit.
   */
  outliers: OutlierEntry[];
}
/**
 * A point that does not fit.
 */
export interface OutlierEntry {
  /**
   * Its number. Unit: 1.
   */
  point: number;
  /**
   * Its line in the table.
   */
  line: number;
  /**
   * Reading − field, µm.
   */
  residual_um: number;
  /**
   * The same in its standard uncertainty. Unit: 1.
   */
  z: number;
}
/**
 * The places of the path.
 */
export interface PlacesEntry {
  /**
   * How many there are.
   */
  all: number;
  /**
   * At how many the cutter touches the part.
   */
  cut: number;
  /**
   * The smallest and the largest move along the normal, µm.
   *
   * @minItems 2
   * @maxItems 2
   */
  moved_um: [number, number];
  /**
   * The largest standard uncertainty of the move, µm.
   */
  largest_u_um: number;
}
/**
 * The wall that remains.
 */
export interface WallEntry {
  /**
   * The nominal thickness, mm.
   */
  thickness_mm: number;
  /**
   * The layer to be removed, mm.
   */
  layer_mm: number;
  /**
   * The least thickness, mm.
   */
  least_mm: number;
  /**
   * Where the map comes from.
   */
  source: string;
  /**
   * As programmed.
   */
  before: WallSpread;
  /**
   * Adapted.
   */
  after: WallSpread;
  /**
   * The smallest and the largest distance from an equal layer, µm.
   *
   * @minItems 2
   * @maxItems 2
   */
  off_equal_layer_um: [number, number];
}
/**
 * The wall over all places of the map.
 */
export interface WallSpread {
  /**
   * The thinnest, mm.
   */
  min_mm: number;
  /**
   * The mean, mm.
   */
  mean_mm: number;
  /**
   * The thickest, mm.
   */
  max_mm: number;
  /**
   * At how many places it is cut through.
   */
  cut_through: number;
  /**
   * How many places the map has.
   */
  places: number;
}
/**
 * One place of the map.
 */
export interface CellEntry {
  /**
   * Where it is, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  at_mm: [number, number, number];
  /**
   * The blank there, µm along the normal.
   */
  blank_um: number;
  /**
   * The field there, µm along the normal.
   */
  field_um: number;
  /**
   * Its standard uncertainty, µm.
   */
  u_field_um: number;
  /**
   * The wall as programmed, mm.
   */
  wall_before_mm: number;
  /**
   * The wall adapted, mm.
   */
  wall_after_mm: number;
  /**
   * Its standard uncertainty, mm.
   */
  u_wall_mm: number;
}
/**
 * The program of the adapted path.
 */
export interface ProgramEntry {
  /**
   * Where it goes.
   */
  file: string;
  /**
   * Whether it was written: only if its proof holds and nothing speaks against the path.
   */
  written: boolean;
  /**
   * Blocks that move the tool along the path.
   */
  blocks: number;
  /**
   * The largest distance of the tip, read back, from the adapted path, µm.
   */
  tip_on_path_um: number;
  /**
   * Of the tool axis, deg.
   */
  axis_on_path_deg: number;
}
/**
 * A program rewritten for the actual machine, with its proof: `trueaxis/compensate-program/1`.
 */
export interface CompensateProgram {
  /**
   * Which document this is.
   */
  schema: "trueaxis/compensate-program/1";
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The program as it was.
   */
  program: string;
  /**
   * The compensated program.
   */
  output: string;
  /**
   * Blocks that move the tool.
   */
  blocks: number;
  /**
   * Blocks of these that were divided.
   */
  split: number;
  /**
   * Blocks that were written for all of them.
   */
  pieces: number;
  /**
   * Circles that became lines.
   */
  circles_to_lines: number;
  /**
   * Words that were added to blocks.
   */
  words_added: number;
  /**
   * The first thousand of them.
   */
  additions: AddedWord[];
  /**
   * Computed words that have a correction added.
   */
  expressions_corrected: number;
  /**
   * The first thousand of them.
   */
  expressions: CorrectedExpression[];
  /**
   * Whether the written program, read back, keeps the residual: only then it is written.
   */
  proved: boolean;
  /**
   * Blocks of rotary axes alone with a new F, so that they take the same time.
   */
  feeds_changed: number;
  /**
   * Places where an axis reverses by less than its reversal error.
   */
  undecided_reversals: number;
  /**
   * Cuts that begin where no corrected word leads, as after a move to machine zero: their ways are not part of the proof.
   */
  begins_elsewhere: number;
  /**
   * Blocks that stay as they are, by reason.
   */
  left: {
    [k: string]: number;
  };
  /**
   * Places where the tool axis keeps its deviation, by reason.
   */
  axis_left: {
    [k: string]: number;
  };
  /**
   * Whether only the tip was corrected.
   */
  position_only: boolean;
  /**
   * How far the tip may be missed between the ends of blocks, mm.
   */
  residual_mm: number;
  /**
   * How far the tool axis may be missed there, rad.
   */
  residual_axis_rad: number;
  /**
   * The least increments; null if numbers were not rounded.
   */
  increments: IncrementsEntry | null;
  /**
   * The largest deviations of the program as it was.
   */
  before: ResidualEntry;
  /**
   * Of the compensated program, read back.
   */
  after: ResidualEntry;
  /**
   * How many ends of blocks were compared.
   */
  ends_compared: number;
  /**
   * The blocks with the largest deviations after compensation.
   */
  worst_blocks: BlockEntry[];
  /**
   * The largest correction of each axis.
   */
  largest_corrections: AxisCorrection[];
  /**
   * The largest relative change of the path length of the tip in a block. Unit: 1.
   */
  way_change_relative: number;
  /**
   * How well the corrections are known.
   */
  uncertainty: UncertaintyEntry;
  /**
   * What would be left without correction and with a wrong sign.
   */
  convention_check: ConventionEntry[];
  /**
   * What to know of this program.
   */
  remarks: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A word that a block did not have.
 */
export interface AddedWord {
  /**
   * The line of the program as it was.
   */
  line: number;
  /**
   * The axis.
   */
  axis: string;
}
/**
 * A computed word that has a correction added.
 */
export interface CorrectedExpression {
  /**
   * The line of the program as it was.
   */
  line: number;
  /**
   * The expression as it was.
   */
  was: string;
  /**
   * What stands there now; in Klartext the calculation before the block.
   */
  is: string;
}
/**
 * The least increments.
 */
export interface IncrementsEntry {
  /**
   * Of linear axes, mm.
   */
  linear_mm: number;
  /**
   * Of rotary axes, deg.
   */
  rotary_deg: number;
}
/**
 * The largest deviations of the actual tool.
 */
export interface ResidualEntry {
  /**
   * Of the tip at the ends of blocks, µm.
   */
  tip_at_ends_um: LineValue;
  /**
   * Of the tool axis at the ends of blocks, µrad.
   */
  axis_at_ends_urad: LineValue;
  /**
   * Of the tip between the ends, µm.
   */
  tip_between_um: LineValue;
  /**
   * Of the tool axis between the ends, µrad.
   */
  axis_between_urad: LineValue;
  /**
   * Root mean square of the tip over the ends of blocks, µm.
   */
  tip_at_ends_rms_um: number;
  /**
   * Of the tool axis over the ends of blocks, µrad.
   */
  axis_at_ends_rms_urad: number;
}
/**
 * A value and the line of the program where it occurs.
 */
export interface LineValue {
  /**
   * The value. Unit: that of the key.
   */
  value: number;
  /**
   * The line of the program as it was, from 1.
   */
  line: number;
}
/**
 * One block.
 */
export interface BlockEntry {
  /**
   * The line of the program as it was, from 1.
   */
  line: number;
  /**
   * Deviation of the tip before, µm.
   */
  tip_before_um: number;
  /**
   * Deviation of the tip after, µm.
   */
  tip_after_um: number;
  /**
   * Deviation of the tool axis before, µrad.
   */
  axis_before_urad: number;
  /**
   * Deviation of the tool axis after, µrad.
   */
  axis_after_urad: number;
}
/**
 * The largest correction of one axis.
 */
export interface AxisCorrection {
  /**
   * The axis.
   */
  axis: string;
  /**
   * The correction. Unit: that of `unit`.
   */
  value: number;
  /**
   * Its unit.
   */
  unit: string;
  /**
   * The line of the program as it was, from 1.
   */
  line: number;
}
/**
 * How well the corrections are known.
 */
export interface UncertaintyEntry {
  /**
   * Places that were examined.
   */
  places: number;
  /**
   * Of these, where the correction is smaller than its standard uncertainty.
   */
  smaller_than_u: number;
  /**
   * The largest standard uncertainty of the tip, µm.
   */
  largest_u_um: number;
}
/**
 * The block with the largest correction under another convention.
 */
export interface ConventionEntry {
  /**
   * Which convention.
   */
  what: string;
  /**
   * Deviation of the tip, µm.
   */
  tip_um: number;
  /**
   * Deviation of the tool axis, µrad.
   */
  axis_urad: number;
}
/**
 * Tables of one control, and what they leave of the errors: `trueaxis/compensate-tables/1`.
 */
export interface CompensateTables {
  /**
   * Which document this is.
   */
  schema: "trueaxis/compensate-tables/1";
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The control, as `--target` names it.
   */
  target: string;
  /**
   * The files that were written.
   */
  files: string[];
  /**
   * The values are added to the command.
   */
  added_to: string;
  /**
   * Where the other axes stand for each table, mm and deg.
   */
  reference: {
    [k: string]: number;
  };
  /**
   * The tables.
   */
  tables: TableEntry[];
  /**
   * Errors that the control's own chain holds.
   */
  known: KnownEntry[];
  /**
   * Lines by which the control follows temperatures.
   */
  temperature: LineEntry[];
  /**
   * Rotary axes in the control's kinematics.
   */
  kinematics: JointEntry[];
  /**
   * The grid of corrections in space; null if there is none.
   */
  grid: GridEntry | null;
  /**
   * What was left out, and why.
   */
  left_out: LeftOutEntry[];
  /**
   * The errors that the tables represent.
   */
  represents: string[];
  /**
   * The errors that they cannot represent.
   */
  cannot: LossEntry[];
  /**
   * Deviation of the tool over the travel without tables, µm.
   */
  before_um: CompensateTablesResidualEntry;
  /**
   * The same with the tables, µm.
   */
  left_um: ProvedEntry;
  /**
   * The same after the part zero was set with the tables in force, the axes at `reference`, µm.
   */
  left_zero_set_um: CompensateTablesResidualEntry;
  /**
   * The same if the control took them with the wrong sign, µm.
   */
  wrong_sign_um: CompensateTablesResidualEntry;
  /**
   * What to do at the control.
   */
  notes: string[];
  /**
   * What tables of the machine alone can cost; present only where the temperature of the workpiece is not
   * known.
   */
  machine_only?: string | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * One table: what is added to one axis by the position of another.
 */
export interface TableEntry {
  /**
   * The axis by whose position the table is read.
   */
  input: string;
  /**
   * The axis to which it adds.
   */
  output: string;
  /**
   * How many nodes it has.
   */
  nodes: number;
  /**
   * Whether the two directions of travel have values of their own.
   */
  by_direction: boolean;
  /**
   * Whether it repeats after a turn.
   */
  modulo: boolean;
  /**
   * The node that adds most; absent if there is none.
   */
  check?: CheckEntry | null;
  [k: string]: number;
}
/**
 * A node to check the sign by.
 */
export interface CheckEntry {
  /**
   * Its position. Unit: mm or deg.
   */
  position: number;
  [k: string]: number;
}
/**
 * An error that the control's own chain holds.
 */
export interface KnownEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  /**
   * How many nodes; 1 if it is constant.
   */
  nodes: number;
  [k: string]: number;
}
/**
 * A line by which the control follows the temperature of a scale.
 */
export interface LineEntry {
  /**
   * The axis.
   */
  axis: string;
  /**
   * The position at which only the offset is added. Unit: mm or deg.
   */
  reference: number;
  /**
   * The slope, µm/m or µrad/rad.
   */
  slope_um_per_m: number;
  [k: string]: number;
}
/**
 * A rotary axis as the control holds it.
 */
export interface JointEntry {
  /**
   * The axis.
   */
  axis: string;
  /**
   * A point on it, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  point_mm: [number, number, number];
  /**
   * Its direction, a unit vector. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  direction: [number, number, number];
  /**
   * By how much the point is off the nominal one, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  moved_um: [number, number, number];
  /**
   * By how much the direction is off the nominal one, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  tilted_urad: [number, number, number];
}
/**
 * A grid of corrections in space.
 */
export interface GridEntry {
  /**
   * Its sides.
   *
   * @minItems 3
   * @maxItems 3
   */
  sides: [SideEntry, SideEntry, SideEntry];
  /**
   * How many points.
   */
  points: number;
  /**
   * What is lost between the points, µm.
   */
  loss_um: number;
  /**
   * The largest correction, µm.
   */
  largest_um: number;
}
/**
 * A side of the grid.
 */
export interface SideEntry {
  /**
   * The axis.
   */
  axis: string;
  /**
   * The first point, mm.
   */
  from_mm: number;
  /**
   * The distance of two points, mm.
   */
  step_mm: number;
  /**
   * How many points.
   */
  points: number;
}
/**
 * An error that the tables cannot represent, alone on the machine.
 */
export interface LossEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  /**
   * Deviation of the tip without tables, µm.
   */
  before_um: number;
  /**
   * With the tables, µm.
   */
  left_um: number;
  /**
   * Where it could be compensated.
   */
  instead: string;
}
/**
 * Deviation of the tool over the travel of all axes.
 */
export interface CompensateTablesResidualEntry {
  /**
   * The largest of the tip. Unit: µm.
   */
  max: number;
  /**
   * Root mean square of the tip. Unit: µm.
   */
  rms: number;
  /**
   * Where the largest is, mm and deg.
   */
  at: {
    [k: string]: number;
  };
  /**
   * How many poses, each from both sides.
   */
  poses: number;
  /**
   * The largest of the tool axis, µrad.
   */
  axis_urad: number;
}
/**
 * The same with the files read back, and on a test piece.
 */
export interface ProvedEntry {
  /**
   * The largest of the tip. Unit: µm.
   */
  max: number;
  /**
   * Root mean square of the tip. Unit: µm.
   */
  rms: number;
  /**
   * Where the largest is, mm and deg.
   */
  at: {
    [k: string]: number;
  };
  /**
   * How many poses, each from both sides.
   */
  poses: number;
  /**
   * The largest of the tool axis, µrad.
   */
  axis_urad: number;
  /**
   * The test piece; null if none was asked for.
   */
  test_piece: PieceEntry | null;
  /**
   * The part by its drawing; absent if none was asked for.
   */
  part?: PartWithTablesEntry | null;
}
/**
 * A test piece cut with the tables.
 */
export interface PieceEntry {
  /**
   * The study.
   */
  study: string;
  /**
   * Its indices.
   */
  indices: PieceIndex[];
}
/**
 * One index of the test piece.
 */
export interface PieceIndex {
  /**
   * Its key.
   */
  index: string;
  /**
   * Without tables, µm.
   */
  before_um: number;
  /**
   * With the tables, µm.
   */
  left_um: number;
}
/**
 * A part by its drawing, before and with the tables. Outcomes are `pass`, `fail` or `undecided`.
 */
export interface PartWithTablesEntry {
  /**
   * The study.
   */
  study: string;
  /**
   * Without tables.
   */
  outcome: string;
  /**
   * With them, the zero where it was set without them.
   */
  zero_kept_outcome: string;
  /**
   * With them, the zero set again.
   */
  zero_set_outcome: string;
  /**
   * The lines of the drawing.
   */
  characteristics: CharacteristicWithTables[];
}
/**
 * A characteristic before and with the tables.
 */
export interface CharacteristicWithTables {
  /**
   * Its name.
   */
  name: string;
  /**
   * Without tables, µm.
   */
  before_um: number;
  /**
   * With them, the zero where it was set without them, µm.
   */
  zero_kept_um: number;
  /**
   * With them, the zero set again, µm.
   */
  zero_set_um: number;
  /**
   * Without tables.
   */
  outcome: string;
  /**
   * With them, the zero kept.
   */
  zero_kept_outcome: string;
  /**
   * With them, the zero set again.
   */
  zero_set_outcome: string;
}
/**
 * Values that the control has to add to its commands: `trueaxis/compensate/1`.
 */
export interface Compensate {
  /**
   * Which document this is.
   */
  schema: "trueaxis/compensate/1";
  /**
   * `values`.
   */
  what: string;
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The values are added to the command.
   */
  added_to: string;
  /**
   * One entry for each axis.
   */
  axes: AxisValues[];
  /**
   * Where compensating the machine alone makes the part worse, or can.
   */
  warnings: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The values of one axis.
 */
export interface AxisValues {
  /**
   * The axis.
   */
  axis: string;
  /**
   * Which error is compensated: `comprehensive` or `machine`.
   */
  of: string;
  /**
   * What the axis carries: `tool` or `workpiece`.
   */
  carries: string;
  /**
   * The least increment, with its unit.
   */
  increment: string;
  /**
   * The values by position.
   */
  positions: PositionValue[];
  [k: string]: {
    [k: string]: number;
  };
}
/**
 * The value at one position.
 */
export interface PositionValue {
  /**
   * The value in least increments.
   */
  value_increments: number;
  /**
   * The value of rising positions; absent if both directions have one value.
   */
  value_up_increments?: number | null;
  /**
   * The value of falling positions; absent if both directions have one value.
   */
  value_down_increments?: number | null;
  [k: string]: Amount;
}
/**
 * The links, errors, sensors, tools and models of a machine. A pose is 12 numbers: its rotation row by row, then
 * its origin in mm. Bodies are given by their index among the links; null is the bed.
 */
export interface Description {
  /**
   * The bodies of the kinematic chain.
   */
  links: LinkEntry[];
  /**
   * The errors of the machine, those without a stated value too.
   */
  errors: ErrorEntry[];
  /**
   * Its temperature sensors.
   */
  sensors: SensorEntry[];
  /**
   * The tool in the spindle; absent where there is no machine.
   */
  tool?: MountedToolEntry | null;
  /**
   * The tools of the machine file.
   */
  tools: ToolAssemblyEntry[];
  /**
   * The models of its bodies.
   */
  models: ModelEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A body of the chain. An axis has `max_velocity_mm_per_s`, `max_acceleration_mm_per_s2` and `max_jerk_mm_per_s3`
 * (`deg` in place of `mm` for a rotary one), null where they are not stated.
 */
export interface LinkEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * `linear`, `rotary`, `workpiece` or `tool`.
   */
  kind: string;
  /**
   * `tool` or `workpiece`: the side of the chain on which it stands.
   */
  carries: string;
  /**
   * The direction of its axis in its own frame; (0 0 1) for workpiece and tool. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  direction: [number, number, number];
  /**
   * +1 where a positive command moves it along the direction, −1 against it (ISO 841); null for no axis.
   * Unit: 1.
   */
  sense: number | null;
  /**
   * The body that carries it.
   */
  parent: number | null;
  /**
   * Its pose on that body with all axes at 0.
   * Unit: 1 of the nine numbers of the rotation, mm of the three of the shift.
   */
  placement: number[];
  /**
   * The pose of what is mounted on it.
   * Unit: 1 of the nine numbers of the rotation, mm of the three of the shift.
   */
  mounting: number[];
  /**
   * The unit of its positions, `mm` or `deg`; null for no axis.
   */
  unit: string | null;
  /**
   * Its travel in that unit; null if it is not stated.
   */
  travel: TravelEntry | null;
  [k: string]: number | null;
}
/**
 * An error of the machine.
 */
export interface ErrorEntry {
  /**
   * Its ISO 230-1 name.
   */
  name: string;
  /**
   * The body that it belongs to.
   */
  body: number;
  /**
   * `location` (constant) or `motion` (varies with the position of the axis).
   */
  kind: string;
  /**
   * The unit of its values.
   */
  unit: string;
  /**
   * Whether the machine file states it.
   */
  stated: boolean;
  /**
   * The shape of its curve; null if it is not stated.
   */
  shape: string | null;
  /**
   * Its text in the machine file.
   */
  text: string | null;
  /**
   * Its line there.
   */
  line: number | null;
  /**
   * The file of its table.
   */
  table: string | null;
  /**
   * Its value, if it is constant. Unit: that of `unit`.
   */
  value: number | null;
  /**
   * Its standard uncertainty, if that is constant. Unit: that of `unit`.
   */
  u: number | null;
  /**
   * Its curve, sampled over the travel.
   */
  curve: ServeDescribeCurveEntry | null;
  /**
   * How it was measured.
   */
  measured: MeasuredEntry | null;
}
/**
 * The curve of an error motion.
 */
export interface ServeDescribeCurveEntry {
  /**
   * Positions of the axis. Unit: that of `at_unit`.
   */
  at: number[];
  /**
   * Their unit, `mm` or `deg`.
   */
  at_unit: string;
  /**
   * The mean of both directions there. Unit: that of the error.
   */
  values: number[];
  /**
   * Positive minus negative direction there; null without reversal. Unit: that of the error.
   */
  reversal: number[] | null;
  /**
   * The standard uncertainty there; null if it is not stated. Unit: that of the error.
   */
  u: number[] | null;
}
/**
 * How an error was measured.
 */
export interface MeasuredEntry {
  /**
   * The instrument.
   */
  instrument: string | null;
  /**
   * The date, as written.
   */
  date: string | null;
  /**
   * The temperature, °C.
   */
  temperature_celsius: number | null;
}
/**
 * A temperature sensor.
 */
export interface SensorEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * What its temperature is used for.
   */
  drives: string[];
}
/**
 * The tool in the spindle.
 */
export interface MountedToolEntry {
  /**
   * Its tip from the gauge line of the spindle, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_mm: [number, number, number];
  /**
   * Its length, mm.
   */
  length_mm: number;
  /**
   * Its diameter, mm, where a tool of the machine file has this length.
   */
  diameter_mm: number | null;
}
/**
 * A tool of the machine file.
 */
export interface ToolAssemblyEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * From the gauge line of the spindle to the tip, mm.
   */
  length_mm: number;
  /**
   * Its cutting diameter, mm.
   */
  diameter_mm: number | null;
  /**
   * Its corner radius, mm.
   */
  corner_radius_mm: number | null;
  /**
   * Its holder, in words.
   */
  holder: string | null;
  /**
   * Its outline from the tip upwards: diameter and length of each cylinder, mm.
   */
  segments_mm: [number, number][];
}
/**
 * The model of a body.
 */
export interface ModelEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * The body that it moves with.
   */
  body: number | null;
  /**
   * Its pose on that body. Unit: 1 of the nine numbers of the rotation, mm of the three of the shift.
   */
  placement: number[];
  /**
   * Its shape.
   */
  shape: ShapeEntry;
}
/**
 * A problem found in the input.
 */
export interface Diagnostic {
  /**
   * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
   */
  code: string;
  /**
   * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
   */
  severity: string;
  /**
   * The file as the user named it, or an argument such as `--at`.
   */
  file: string;
  /**
   * The line, from 1; 0 for the file as a whole.
   */
  line: number;
  /**
   * The column in characters, from 1; 0 for the file as a whole.
   */
  column: number;
  /**
   * The problem in one sentence.
   */
  message: string;
  /**
   * What to do; empty if it follows from the message.
   */
  hint: string;
}
/**
 * Two calibrations of one machine: which errors have changed.
 */
export interface Diff {
  /**
   * Which document this is.
   */
  schema: "trueaxis/diff/1";
  /**
   * The version of TrueAxis.
   */
  version: string;
  /**
   * The name of the newer machine.
   */
  machine: string;
  /**
   * Its kinematic chain from the workpiece to the tool.
   */
  chain: string;
  /**
   * The older file.
   */
  old: string;
  /**
   * The newer file.
   */
  new: string;
  /**
   * The names of the errors that have changed significantly.
   */
  moved: string[];
  /**
   * The bound of the change of one error in its standard uncertainty, so that among all errors none is
   * above it by chance with 95 %. Unit: 1.
   */
  limit_u: number;
  /**
   * All errors.
   */
  errors: ErrorChangeEntry[];
  /**
   * What the changes do to the tip.
   */
  tip: TipChangeEntry;
  /**
   * The tables that hold at two temperatures.
   */
  temperatures: TwoTemperaturesEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * How one error has changed, where the change is clearest.
 */
export interface ErrorChangeEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  /**
   * The unit of its values: `um` or `urad`.
   */
  unit: string;
  /**
   * Its old value; null if the old file does not state it. Unit: that of `unit`.
   */
  old: number | null;
  /**
   * Its new value; null if the new file does not state it. Unit: that of `unit`.
   */
  new: number | null;
  /**
   * New − old. Unit: that of `unit`.
   */
  change: number | null;
  /**
   * Root mean square of the change over the travel. Unit: that of `unit`.
   */
  rms_change: number;
  /**
   * Standard uncertainty of the change; null if a file states none. Unit: that of `unit`.
   */
  u_change: number | null;
  /**
   * |change| over its expanded uncertainty (k = 2), ISO 13528. Unit: 1.
   */
  E_n: number | null;
  /**
   * The position; null for location errors.
   */
  at: AxisPositionEntry | null;
  /**
   * `yes`, `perhaps`, `no`, `unknown`, `new` (only in the new file) or `gone` (only in the old one).
   */
  moved: string;
}
/**
 * A position of one axis.
 */
export interface AxisPositionEntry {
  /**
   * The name of the axis.
   */
  axis: string;
  /**
   * Its position. Unit: that of `unit`.
   */
  position: number;
  /**
   * `mm` or `deg`.
   */
  unit: string;
  /**
   * The side from which it is approached: +1, −1, or 0 for the mean of both. Unit: 1.
   */
  approach: number;
}
/**
 * What the changes do to the tip.
 */
export interface TipChangeEntry {
  /**
   * How many poses were evaluated.
   */
  poses: number;
  /**
   * The largest change of the tip, µm.
   */
  largest_um: number;
  /**
   * Its standard uncertainty, µm.
   */
  u_um: number;
  /**
   * The axis positions of the largest change, mm and degrees.
   */
  at: {
    [k: string]: number;
  };
  /**
   * Root mean square over the poses, µm.
   */
  rms_um: number;
  /**
   * The largest change of the tool axis, µrad.
   */
  axis_largest_urad: number;
  /**
   * The largest difference of the nominal machines at the tip, mm; 0 if they are the same.
   */
  nominal_difference_mm: number;
  /**
   * The change of each error alone, the largest first.
   */
  shares: TipShareEntry[];
}
/**
 * The change of one error alone.
 */
export interface TipShareEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  /**
   * How far it moves the tip at most, µm.
   */
  largest_um: number;
}
/**
 * A table of the older file, referred to the temperature of that of the newer one.
 */
export interface TwoTemperaturesEntry {
  /**
   * The error.
   */
  error: string;
  /**
   * The temperature of the older table.
   */
  old_degC: number;
  /**
   * That of the newer one.
   */
  new_degC: number;
  /**
   * The expansion by which the older one is referred; null where no file states one: both are compared as they are.
   */
  expansion_um_per_m_k: number | null;
}
/**
 * The form of points: `trueaxis/evaluate-form/1`.
 */
export interface EvaluateForm {
  /**
   * Which document this is.
   */
  schema: "trueaxis/evaluate-form/1";
  /**
   * The version of the program.
   */
  version: string;
  /**
   * The file of the points.
   */
  file: string;
  /**
   * `line`, `plane`, `circle`, `sphere`, `cylinder` or `cone`.
   */
  element: string;
  /**
   * What its form deviation is called, such as `roundness`.
   */
  deviation: string;
  /**
   * How many points the file has.
   */
  points: number;
  /**
   * The normal of the plane of a profile or circle, if it is known. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  plane_normal: [number, number, number] | null;
  /**
   * The filter; null if there is none.
   */
  filter: string | null;
  /**
   * The reference element that decides: `LSC`, `MZC`, `MCC` or `MIC`.
   */
  reference: string;
  /**
   * The form deviation by it, µm.
   */
  form_um: number;
  /**
   * Its expanded uncertainty, µm; null if nothing is known of the points.
   */
  U_um: number | null;
  /**
   * The tolerance, µm; null if there is none.
   */
  tolerance_um: number | null;
  /**
   * `pass`, `fail` or `undecided` by ISO 14253-1; null without a tolerance.
   */
  decision: string | null;
  /**
   * The least-squares element.
   */
  least_squares: LeastSquaresEntry;
  /**
   * Every reference element.
   */
  references: ReferenceEntry[];
  /**
   * Angle with points, degrees; null for lines and planes.
   */
  covered_deg: number | null;
  /**
   * Deviations of the points from the deciding element, after the filter, µm.
   */
  deviations_um: number[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The least-squares element with standard uncertainties (k = 1); null where nothing is known of the points.
 */
export interface LeastSquaresEntry {
  /**
   * Centre, or point of the element next to the middle of the points, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  point_mm: [number, number, number];
  /**
   * Its standard uncertainty, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  point_u_mm: [number, number, number] | null;
  /**
   * Direction of the line or axis, or normal; null for a sphere. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  direction: [number, number, number] | null;
  /**
   * Its standard uncertainty. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  direction_u: [number, number, number] | null;
  /**
   * Angle to the nearest axis of the frame, degrees; null for a sphere.
   */
  tilt_deg: number | null;
  /**
   * That axis.
   */
  tilt_to: string | null;
  /**
   * Its standard uncertainty, degrees.
   */
  tilt_u_deg: number | null;
  /**
   * Radius, of a cone at its point; null for lines and planes, mm.
   */
  radius_mm: number | null;
  /**
   * Its standard uncertainty, mm.
   */
  radius_u_mm: number | null;
  /**
   * Half of the angle at the apex of a cone, degrees.
   */
  half_angle_deg: number | null;
  /**
   * Its standard uncertainty, degrees.
   */
  half_angle_u_deg: number | null;
  /**
   * Apex of a cone, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  apex_mm: [number, number, number] | null;
  /**
   * Standard deviation of the residuals, µm.
   */
  residual_um: number;
  /**
   * Their degrees of freedom.
   */
  degrees_of_freedom: number;
  /**
   * Standard deviation along the normal of a circle, if its plane was fitted, µm.
   */
  axial_residual_um: number | null;
  /**
   * Standard uncertainty of a point that the others follow from, µm.
   */
  point_uncertainty_um: number | null;
  /**
   * Where it comes from: `stated`, `scatter`, or `scatter, larger than stated`.
   */
  uncertainty_from: string | null;
  /**
   * k for U of these values. Unit: 1.
   */
  coverage_factor: number | null;
}
/**
 * One reference element.
 */
export interface ReferenceEntry {
  /**
   * `LSC`, `MZC`, `MCC` or `MIC`.
   */
  reference: string;
  /**
   * The form deviation, µm.
   */
  form_um: number;
  /**
   * Its expanded uncertainty, µm.
   */
  U_um: number | null;
  /**
   * Its standard deviation by noise of the points, µm.
   */
  noise_u_um: number | null;
  /**
   * What noise adds to it at most, µm.
   */
  noise_bias_um: number | null;
  /**
   * Centre, or point of the element, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  point_mm: [number, number, number];
  /**
   * Direction or normal; null for a sphere. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  direction: [number, number, number] | null;
  /**
   * Radius; null for lines and planes, mm.
   */
  radius_mm: number | null;
  /**
   * Half of the angle at the apex of a cone, degrees.
   */
  half_angle_deg: number | null;
  /**
   * `global`, `bound`, `local` or `none`; null for least squares.
   */
  proof: string | null;
  /**
   * With `bound`: no other element has a smaller form deviation (inscribed: larger radius) than this, mm.
   */
  bound_mm: number | null;
  /**
   * With `local`: starts that were tried, and those that came to this result.
   *
   * @minItems 2
   * @maxItems 2
   */
  starts: [number, number] | null;
  /**
   * The points that hold it.
   */
  contacts: ContactEntry[];
}
/**
 * A point that holds an element.
 */
export interface ContactEntry {
  /**
   * Its number, from 1, after the filter.
   */
  point: number;
  /**
   * `outer` or `inner`.
   */
  side: string;
  /**
   * Its multiplier. Unit: 1.
   */
  weight: number;
}
/**
 * Figures against their tolerances.
 */
export interface DecisionsEntry {
  /**
   * `ISO 14253-1` or `simple`.
   */
  rule: string;
  /**
   * `conforming`, `not conforming` or `neither proved`: the worst of all.
   */
  decision: string;
  /**
   * Every figure that has a tolerance.
   */
  figures: ServeEvaluateDecisionEntry[];
}
/**
 * A figure with its tolerance.
 */
export interface ServeEvaluateDecisionEntry {
  /**
   * Its name.
   */
  figure: string;
  /**
   * Effective degrees of freedom of U; null for infinitely many, and where U is not known. Unit: 1.
   */
  degrees_of_freedom: number | null;
  /**
   * The coverage factor of U; null where U is not known. Unit: 1.
   */
  k: number | null;
  /**
   * `conforming`, `not conforming` or `neither proved`.
   */
  decision: string;
  [k: string]: number | null;
}
/**
 * A circle as errors of the machine file.
 */
export interface MachineErrorsEntry {
  /**
   * The errors that change.
   */
  written: WrittenEntry[];
  /**
   * The causes that change nothing, and why.
   */
  left: LeftEntry[];
  /**
   * Every cause in the readings and as the virtual ball-bar of the machine file shows it, before and after.
   */
  compared: ComparedEntry[];
  /**
   * Standard deviation of reading − virtual ball-bar of the machine file as it was, µm.
   */
  residual_before_um: number;
  /**
   * The same of the new machine file, µm.
   */
  residual_after_um: number;
}
/**
 * An error of the machine file that changes.
 */
export interface WrittenEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  /**
   * What the file states now.
   */
  value: string;
  /**
   * The causes that it states.
   */
  causes: string[];
}
/**
 * A cause that changes nothing.
 */
export interface LeftEntry {
  /**
   * Which.
   */
  cause: string;
  /**
   * Of which axis; null where it belongs to both.
   */
  axis: string | null;
  /**
   * Why.
   */
  why: string;
}
/**
 * A cause before and after.
 */
export interface ComparedEntry {
  /**
   * Which.
   */
  cause: string;
  /**
   * Of which axis; null where it belongs to both.
   */
  axis: string | null;
  /**
   * `um` or `urad`: the unit of the numbers.
   */
  unit: string;
  /**
   * From the readings. Unit: that of `unit`.
   */
  read: number;
  /**
   * From the machine file as it was. Unit: that of `unit`.
   */
  before: number;
  /**
   * From the new machine file. Unit: that of `unit`.
   */
  after: number;
}
/**
 * Positioning of an axis. Deviations of linear axes end in `_um` (µm), those of rotary axes are given twice, in
 * `_urad` (µrad) and `_arcsec` (arcseconds). For each unit there are the quantities `A`, `A_up`, `A_down`, `R`,
 * `R_up`, `R_down`, `E`, `E_up`, `E_down`, `M`, `B` and `B_mean` of ISO 230-2, then an object `U` with their
 * expanded uncertainties (k = 2).
 */
export interface PositioningEntry {
  /**
   * `linear` or `rotary`.
   */
  kind: string;
  /**
   * The measured length of a linear axis, mm.
   */
  travel_mm?: number | null;
  /**
   * The measured angle of a rotary axis, degrees.
   */
  travel_deg?: number | null;
  /**
   * Every target position.
   */
  positions: PositionEntry[];
  /**
   * Standard uncertainties by ISO/TR 230-9, each key with its unit; null if nothing is known of the
   * instrument. An entry is null where it does not apply.
   */
  budget: {
    [k: string]: number | null;
  } | null;
  /**
   * `P`, `Pa`, `Ps` and `U` of VDI/DGQ 3441, each key with its unit; null where the readings do not allow it.
   */
  vdi3441: {
    [k: string]: number | null;
  };
  /**
   * The quantities in the form of ASME B5.54, each key with its unit; null where the readings do not allow it.
   */
  b5_54_form: {
    [k: string]: number | null;
  };
}
/**
 * One target position. For each unit there are the means `mean_up`, `mean_down` and `mean`, the standard
 * deviations `s_up` and `s_down`, the reversal value `B` and the repeatabilities `R_up`, `R_down` and `R`.
 */
export interface PositionEntry {
  /**
   * The target of a linear axis, mm.
   */
  target_mm?: number | null;
  /**
   * The target of a rotary axis, degrees.
   */
  target_deg?: number | null;
  /**
   * How many readings were approached in the positive direction.
   */
  n_up: number;
  /**
   * How many readings were approached in the negative direction.
   */
  n_down: number;
  [k: string]: number | null;
}
/**
 * A geometric test.
 */
export interface GeometricEntry {
  /**
   * `straightness`, `flatness`, `squareness` or `parallelism`.
   */
  kind: string;
  /**
   * The machine error that it is, such as `EYX`; null if none is stated.
   */
  error: string | null;
  /**
   * All quantities; the first one is judged.
   */
  quantities: GeometricQuantityEntry[];
  /**
   * What is allowed of the first quantity, µm; null without tolerance or for an angle.
   */
  tolerance_um: number | null;
  /**
   * What is allowed of the first quantity, µrad; null without tolerance or for a length.
   */
  tolerance_urad: number | null;
  /**
   * `pass`, `fail` or `undecided` by ISO 14253-1; null without tolerance.
   */
  outcome: string | null;
  /**
   * Standard deviation of a reading from runs or closure, µm; null if it is not known or an angle.
   */
  reading_s_um: number | null;
  /**
   * Standard deviation of a reading from runs or closure, µrad; null if it is not known or a length.
   */
  reading_s_urad: number | null;
  /**
   * Degrees of freedom of this standard deviation; null without it. Unit: 1.
   */
  degrees_of_freedom: number | null;
  /**
   * The lines about their reference.
   */
  lines: GeometricLineEntry[];
  /**
   * The points of a surface.
   */
  surface: SurfacePointEntry[];
  /**
   * The closure errors of the lines of a surface.
   */
  closures: ClosureEntry[];
}
/**
 * A quantity of a geometric test: in µm or in µrad.
 */
export interface GeometricQuantityEntry {
  /**
   * Its name; of a squareness the machine error.
   */
  name: string;
  /**
   * Its value, µm; null for an angle.
   */
  value_um: number | null;
  /**
   * Its expanded uncertainty, 95 %, µm; null for an angle, or if it is not known.
   */
  u_um: number | null;
  /**
   * Its value, µrad; null for a length.
   */
  value_urad: number | null;
  /**
   * Its expanded uncertainty, 95 %, µrad; null for a length, or if it is not known.
   */
  u_urad: number | null;
}
/**
 * A line about its reference.
 */
export interface GeometricLineEntry {
  /**
   * Which.
   */
  name: string;
  /**
   * Positions, mm.
   */
  positions_mm: number[];
  /**
   * Deviations, µm.
   */
  deviations_um: number[];
}
/**
 * A point of a surface.
 */
export interface SurfacePointEntry {
  /**
   * Place, mm.
   */
  x_mm: number;
  /**
   * Place, mm.
   */
  y_mm: number;
  /**
   * Deviation from the reference plane, µm.
   */
  deviation_um: number;
}
/**
 * What the closure of a surface changed of a line.
 */
export interface ClosureEntry {
  /**
   * The line.
   */
  line: string;
  /**
   * How far its own profile is from the surface, at most, µm.
   */
  largest_um: number;
}
/**
 * A circular test by ISO 230-4. For each sense (`ccw`, `cw`), the worst of its paths, there are `G_ccw_um`, `F_ccw_max_um` and
 * `F_ccw_min_um`, then the same over all paths: `G_um`, `G_b_um`, `F_max_um`, `F_min_um` and `D_um`.
 */
export interface CircularEntry {
  /**
   * The two axes.
   *
   * @minItems 2
   * @maxItems 2
   */
  axes: [string, string];
  /**
   * The nominal radius, mm; null if none is stated.
   */
  radius_mm: number | null;
  /**
   * The centre that deviations are counted from, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  centre_mm: [number, number];
  /**
   * Every path.
   */
  paths: PathEntry[];
  /**
   * The causes of the deviations; null if they cannot be separated.
   */
  causes: CausesEntry | null;
  /**
   * All causes with uncertainties and shares; null without a whole circle in both directions and its radius.
   */
  diagnosis: DiagnosisEntry | null;
}
/**
 * One path of a circular test.
 */
export interface PathEntry {
  /**
   * `ccw` or `cw`.
   */
  direction: string;
  /**
   * How many points it has.
   */
  points: number;
  /**
   * The overlap that was left out, degrees.
   */
  overlap_left_out_deg: number;
  /**
   * Circular deviation, µm.
   */
  G_um: number;
  /**
   * Largest radial deviation, µm; null without a nominal radius.
   */
  F_max_um: number | null;
  /**
   * Smallest radial deviation, µm; null without a nominal radius.
   */
  F_min_um: number | null;
  /**
   * Mean radial deviation, µm; null without a nominal radius.
   */
  mean_radial_um: number | null;
  /**
   * Centre of the least-squares circle, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  centre_mm: [number, number];
  /**
   * Its radius, mm.
   */
  mean_radius_mm: number;
}
/**
 * The causes of the deviations of a circular test, by least squares.
 */
export interface CausesEntry {
  /**
   * Reversal error of each axis, µm.
   */
  backlash_um: {
    [k: string]: number;
  };
  /**
   * Scale of the first axis − that of the second, over the diameter, µm.
   */
  scale_mismatch_um: number;
  /**
   * Squareness, positive if closer than 90°, µrad; null if one sense alone cannot separate it.
   */
  squareness_urad: number | null;
  /**
   * Servo mismatch, counterclockwise along +45°, µm; null if one sense alone cannot separate it.
   */
  servo_mismatch_um: number | null;
  /**
   * Squareness and servo mismatch together, µm; null if they are separated.
   */
  diagonal_ellipse_um: number | null;
  /**
   * The centre, µm.
   *
   * @minItems 2
   * @maxItems 2
   */
  centre_um: [number, number];
  /**
   * The spikes at the reversals.
   */
  spikes: SpikeEntry[];
  /**
   * Root mean square of the residuals, µm.
   */
  residual_rms_um: number;
}
/**
 * A spike after a reversal.
 */
export interface SpikeEntry {
  /**
   * The axis that reverses.
   */
  axis: string;
  /**
   * Where on the circle, degrees.
   */
  at_deg: number;
  /**
   * `ccw` or `cw`.
   */
  direction: string;
  /**
   * Largest residual after the reversal, outward positive, µm.
   */
  height_um: number;
}
/**
 * The causes of a circle with their uncertainties and shares.
 */
export interface DiagnosisEntry {
  /**
   * The causes, the largest share first.
   */
  causes: CauseEntry[];
  /**
   * Standard deviation of the residuals, µm.
   */
  residual_um: number;
  /**
   * Degrees of freedom of the residuals, which follow each other closely. Unit: 1.
   */
  degrees_of_freedom: number;
  /**
   * By how much the axes lag one another, s; null where no feed is stated.
   */
  servo_lag_s: number | null;
}
/**
 * One cause: its value with U, in µm or µrad, and what it does to the circle.
 */
export interface CauseEntry {
  /**
   * `squareness`, `scale-mismatch`, `size`, `servo-mismatch`, `backlash`, `lateral-play`, `straightness`,
   * `cyclic-error`, `reversal-spike` or `unexplained`.
   */
  cause: string;
  /**
   * The axis that it belongs to; null where it belongs to both.
   */
  axis: string | null;
  /**
   * Its value, µm; null for an angle.
   */
  value_um: number | null;
  /**
   * Its expanded uncertainty (95.45 %), µm; null for an angle.
   */
  U_um: number | null;
  /**
   * Its value, µrad; null for a length.
   */
  value_urad: number | null;
  /**
   * Its expanded uncertainty (95.45 %), µrad; null for a length.
   */
  U_urad: number | null;
  /**
   * Effective degrees of freedom (Welch-Satterthwaite); null for infinitely many. Unit: 1.
   */
  degrees_of_freedom: number | null;
  /**
   * The coverage factor of U. Unit: 1.
   */
  k: number;
  /**
   * A backlash where the axis reverses at its positive and its negative end, µm; null for others.
   *
   * @minItems 2
   * @maxItems 2
   */
  ends_um: [number, number] | null;
  /**
   * The bidirectional circular deviation that it makes alone, µm.
   */
  alone_um: number;
  /**
   * Its part of the sum of all these, percent.
   */
  share_percent: number;
}
/**
 * Drift by ISO 230-3.
 */
export interface DriftEntry {
  /**
   * Length of the windows, s.
   */
  window_s: number;
  /**
   * How long the test lasts, s.
   */
  duration_s: number | null;
  /**
   * Every channel.
   */
  channels: ChannelEntry[];
}
/**
 * One channel: `range`, `first_window`, `largest_window`, `largest_window_at_most` (if it changes within gaps of the record at the worst
 * moment) and `end`, each with the unit `_um`, `_urad` or `_degC`.
 */
export interface ChannelEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Where the window of the largest range begins, s.
   */
  largest_window_from_s: number;
  [k: string]: number;
}
/**
 * Diagonals by ISO 230-6: the largest of all, then each. A value is null if the readings do not allow it.
 */
export interface DiagonalsEntry {
  /**
   * Bidirectional systematic deviation, µm.
   */
  E_d_um: number | null;
  /**
   * Systematic deviation in the positive direction, µm.
   */
  E_d_up_um: number | null;
  /**
   * Systematic deviation in the negative direction, µm.
   */
  E_d_down_um: number | null;
  /**
   * Bidirectional repeatability, µm.
   */
  R_d_um: number | null;
  /**
   * Reversal value, µm.
   */
  B_d_um: number | null;
  /**
   * Bidirectional accuracy, µm.
   */
  A_d_um: number | null;
  /**
   * Every diagonal.
   */
  diagonals: DiagonalEntry[];
  /**
   * Squareness from pairs of diagonals.
   */
  squareness: SquarenessEntry[];
}
/**
 * One diagonal.
 */
export interface DiagonalEntry {
  /**
   * Its name by the signs of the axes.
   */
  diagonal: string;
  /**
   * Its elongation, µm/m; null if the readings do not allow it.
   */
  stretch_um_per_m: number | null;
  /**
   * `linear` or `rotary`.
   */
  kind: string;
  /**
   * The measured length of a linear axis, mm.
   */
  travel_mm?: number | null;
  /**
   * The measured angle of a rotary axis, degrees.
   */
  travel_deg?: number | null;
  /**
   * Every target position.
   */
  positions: PositionEntry[];
  /**
   * Standard uncertainties by ISO/TR 230-9, each key with its unit; null if nothing is known of the
   * instrument. An entry is null where it does not apply.
   */
  budget: {
    [k: string]: number | null;
  } | null;
  /**
   * `P`, `Pa`, `Ps` and `U` of VDI/DGQ 3441, each key with its unit; null where the readings do not allow it.
   */
  vdi3441: {
    [k: string]: number | null;
  };
  /**
   * The quantities in the form of ASME B5.54, each key with its unit; null where the readings do not allow it.
   */
  b5_54_form: {
    [k: string]: number | null;
  };
  [k: string]: QuantityEntry;
}
/**
 * Squareness of two axes, as their diagonals suggest it.
 */
export interface SquarenessEntry {
  /**
   * The two axes.
   */
  axes: string;
  /**
   * By how much they are closer than 90°, µrad.
   */
  closer_urad: number;
  /**
   * `body` or `face` diagonals.
   */
  from: string;
}
/**
 * Error motions of a rotary axis by ISO 230-7.
 */
export interface RotationEntry {
  /**
   * How many full revolutions were evaluated.
   */
  revolutions: number;
  /**
   * Readings in each revolution.
   */
  readings_per_revolution: number;
  /**
   * Readings outside the full revolutions.
   */
  readings_left_out: number;
  /**
   * The error motions.
   */
  motions: MotionEntry[];
}
/**
 * One error motion.
 */
export interface MotionEntry {
  /**
   * The sensitive direction.
   */
  sensitive: string;
  /**
   * Total error motion, µm.
   */
  total_um: number;
  /**
   * Synchronous error motion, µm.
   */
  synchronous_um: number;
  /**
   * Asynchronous error motion, µm; null for one revolution.
   */
  asynchronous_um: number | null;
  /**
   * The part once per revolution, µm.
   */
  fundamental_um: number;
}
/**
 * A probing test.
 */
export interface ProbingEntry {
  /**
   * The quantities.
   */
  quantities: ProbingQuantityEntry[];
  /**
   * Standard deviation of a hit at one point, µm; null without repeated hits.
   */
  hit_s_um: number | null;
  /**
   * Degrees of freedom of it; null without repeated hits. Unit: 1.
   */
  degrees_of_freedom: number | null;
  /**
   * The deviations of rings and spheres.
   */
  deviations: ProbingDeviationsEntry[];
}
/**
 * A quantity of a probing test.
 */
export interface ProbingQuantityEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its value, µm.
   */
  value_um: number;
  /**
   * Its expanded uncertainty, 95 %, µm; null of a range of repeated readings, or if it is not known.
   */
  u_um: number | null;
  /**
   * What is allowed, µm; null without tolerance.
   */
  tolerance_um: number | null;
  /**
   * `pass`, `fail` or `undecided`; null without tolerance.
   */
  outcome: string | null;
}
/**
 * The deviations of a ring or sphere from its least-squares element.
 */
export interface ProbingDeviationsEntry {
  /**
   * Which.
   */
  name: string;
  /**
   * Angles in the plane x y, degrees.
   */
  angles_deg: number[];
  /**
   * Height angles over this plane, degrees; 0 of a ring.
   */
  heights_deg: number[];
  /**
   * Deviations of the radius, µm.
   */
  deviations_um: number[];
}
/**
 * The codes of all diagnostics.
 */
export interface ExplainList {
  /**
   * Which document this is.
   */
  schema: "trueaxis/explain/1";
  /**
   * All codes.
   */
  codes: CodeEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * One code.
 */
export interface CodeEntry {
  /**
   * The code.
   */
  code: string;
  /**
   * The part of the program that reports it.
   */
  room: string;
  /**
   * Its meaning in one sentence.
   */
  title: string;
}
/**
 * The meaning of one diagnostic.
 */
export interface Explain {
  /**
   * Which document this is.
   */
  schema: "trueaxis/explain/1";
  /**
   * The code.
   */
  code: string;
  /**
   * Its meaning in one sentence.
   */
  title: string;
  /**
   * Its meaning, its cause and what to do, Markdown.
   */
  text: string;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * Figures of one machine over its calibrations: `trueaxis/history/1`.
 */
export interface History {
  /**
   * Which document this is.
   */
  schema: "trueaxis/history/1";
  /**
   * The version of the program.
   */
  version: string;
  /**
   * The machine.
   */
  machine: string;
  /**
   * Whether nothing needs attention: no jump, no point outside of the control limits, no limit exceeded.
   */
  quiet: boolean;
  /**
   * Every figure with at least two dates.
   */
  series: SeriesEntry[];
  /**
   * Figures with one date only.
   */
  single: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A figure over time.
 */
export interface SeriesEntry {
  /**
   * Its name.
   */
  figure: string;
  /**
   * The unit of its numbers: `um`, `urad`, `arcsec`.
   */
  unit: string;
  /**
   * Its points by date.
   */
  points: PointEntry[];
  /**
   * Change in a year. Unit: that of `unit`.
   */
  slope_per_year: number | null;
  /**
   * Its expanded uncertainty (95.45 %); null where nothing is known of it. Unit: that of `unit`.
   */
  U_slope_per_year: number | null;
  /**
   * Its degrees of freedom; null for infinitely many. Unit: 1.
   */
  degrees_of_freedom: number | null;
  /**
   * Its coverage factor. Unit: 1.
   */
  k: number | null;
  /**
   * Lower limit, mean and upper limit of the chart of individuals; null below three points. Unit: that of `unit`.
   *
   * @minItems 3
   * @maxItems 3
   */
  control_limits: [number, number, number] | null;
  /**
   * The dates of points outside of them.
   */
  outside: string[];
  /**
   * Changes beyond U of both calibrations.
   */
  jumps: JumpEntry[];
  /**
   * The limit; null where none is stated. Unit: that of `unit`.
   */
  limit: number | null;
  /**
   * Whether the last value is beyond the limit; null where none is stated.
   */
  exceeded: boolean | null;
  /**
   * When the trend reaches the limit; null if not within a century.
   */
  reached: string | null;
  /**
   * The same as early as U of the slope allows.
   */
  reached_earliest: string | null;
}
/**
 * A figure on a day.
 */
export interface PointEntry {
  /**
   * The date.
   */
  date: string;
  /**
   * The value. Unit: that of `unit`.
   */
  value: number;
  /**
   * Its standard uncertainty; null where none is stated. Unit: that of `unit`.
   */
  u: number | null;
  /**
   * The file.
   */
  file: string;
}
/**
 * A change from one calibration to the next.
 */
export interface JumpEntry {
  /**
   * From when.
   */
  from: string;
  /**
   * To when.
   */
  to: string;
  /**
   * The change. Unit: that of `unit`.
   */
  change: number;
  /**
   * Its expanded uncertainty (k = 2). Unit: that of `unit`.
   */
  U: number;
}
/**
 * Errors identified from the readings of a campaign.
 */
export interface IdentifyErrors {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify/1";
  /**
   * Name of the campaign.
   */
  name: string;
  /**
   * Name of the machine.
   */
  machine: string;
  /**
   * Date of the measurement as written; null if none is stated.
   */
  date: string | null;
  /**
   * Whether the model explains the readings.
   */
  verdict: VerdictEntry;
  /**
   * The stages one after the other; empty if the campaign has none.
   */
  stages: StageEntry[];
  /**
   * The largest difference between the stages and all readings at once, in standard uncertainties; null
   * without stages. Unit: 1.
   */
  stages_differ_by_u: number | null;
  /**
   * The errors of the machine.
   */
  errors: FoundEntry[];
  /**
   * The errors of the set-up of the instruments.
   */
  setup: FoundEntry[];
  /**
   * Combinations of errors that change no reading.
   */
  unobservable: Unobservable[];
  /**
   * Candidate terms that the readings do not support.
   */
  left_out: string[];
  /**
   * Root mean square of the residual of length readings, in sample, µm; null without such readings.
   */
  rms_in_um: number | null;
  /**
   * The same on places that the model had not seen, µm.
   */
  rms_held_out_um: number | null;
  /**
   * Repeatability of the readings, µm.
   */
  repeatability_um: number | null;
  /**
   * Whether the repeatability comes from repeated readings; if not, it is the stated noise.
   */
  repeatability_is_measured: boolean;
  /**
   * Root mean square without the unknown errors, set-up only, µm.
   */
  rms_without_model_um: number | null;
  /**
   * The same figures for lengths and angles.
   */
  rms: RmsEntries;
  /**
   * Number of readings.
   */
  readings: number;
  /**
   * Number of places.
   */
  places: number;
  /**
   * Rank of the design matrix.
   */
  rank: number;
  /**
   * Its condition number. Unit: 1.
   */
  condition: number;
  /**
   * Relative singular value below which a combination counts as unobservable. Unit: 1.
   */
  threshold: number;
  /**
   * `full` or `linear`.
   */
  model: string;
  /**
   * χ² of the fit. Unit: 1.
   */
  chi_square: number;
  /**
   * Its degrees of freedom.
   */
  degrees_of_freedom: number;
  /**
   * The feeds of the readings, and the lags that they cannot separate.
   */
  feeds: Feeds;
  /**
   * Factor by which the uncertainties are enlarged, 1 or more. Unit: 1.
   */
  birge_ratio: number;
  /**
   * The test of the residual.
   */
  test: TestEntry;
  /**
   * The largest coverage factor of the values. Unit: 1.
   */
  coverage_factor: number;
  /**
   * What the residual follows, the most evident first.
   */
  residual_follows: IdentifyErrorsFieldEntry[];
  /**
   * How well readings are predicted; null if that was not asked for.
   */
  prediction: PredictionEntry | null;
  /**
   * How the terms were selected.
   */
  selection: SelectionEntry;
  /**
   * Readings beyond the limit of studentised residuals.
   */
  outliers: IdentifyErrorsOutlierEntry[];
  /**
   * That limit, in standard deviations. Unit: 1.
   */
  outlier_limit: number;
  /**
   * The readings that change the result most if they are left out.
   */
  most_influential: InfluenceEntry[];
  /**
   * The conventions that were tried; null if that was not asked for.
   */
  conventions: ConventionCheck | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The result.
 */
export interface VerdictEntry {
  /**
   * `explained`, `over-fitted`, `follows-xyz`, `turns-with-axis`, `arrangement`, `reverses`, `drifts`,
   * `gross-readings`, `unexplained` or `stages-contradict`.
   */
  key: string;
  /**
   * In words.
   */
  words: string;
  /**
   * Whether the model may be trusted.
   */
  good: boolean;
}
/**
 * A stage for programs.
 */
export interface StageEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * When it was done, as written; null if none is stated.
   */
  date: string | null;
  /**
   * How many numbers were read.
   */
  numbers: number;
  /**
   * What was found without the axes of the machine, in words.
   */
  found: string[];
  /**
   * By how much its readings scatter more than stated, 1 or more. Unit: 1.
   */
  birge_ratio: number;
  /**
   * Whether it agrees with the stages before it; null if they say nothing of the same.
   */
  agreement: ServeIdentifyAgreementEntry | null;
  /**
   * Every unknown after this stage.
   */
  known: StageValue[];
}
/**
 * The test of a stage against the stages before it.
 */
export interface ServeIdentifyAgreementEntry {
  /**
   * χ². Unit: 1.
   */
  chi_square: number;
  /**
   * Its degrees of freedom.
   */
  degrees_of_freedom: number;
  /**
   * Probability of a larger χ² by chance. Unit: 1.
   */
  p: number;
  /**
   * Whether they contradict each other.
   */
  conflict: boolean;
  /**
   * The unknown that differs most; null if none can be compared alone.
   */
  worst: string | null;
}
/**
 * An unknown after a stage.
 */
export interface StageValue {
  /**
   * Its name.
   */
  name: string;
  /**
   * `um`, `urad`, `ms` or `um/m`.
   */
  unit: string;
  /**
   * Its value; null if it is not known yet. Unit: that of `unit`.
   */
  value: number | null;
  /**
   * Its standard uncertainty. Unit: that of `unit`.
   */
  u: number | null;
  /**
   * Its standard uncertainty before this stage; null if it was not known. Unit: that of `unit`.
   */
  u_before: number | null;
}
/**
 * One unknown.
 */
export interface FoundEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * The standard uncertainty again. Unit: that of the value.
   */
  u: number | null;
  /**
   * Value divided by its standard uncertainty. Unit: 1.
   */
  z: number | null;
  /**
   * Effective degrees of freedom of u; null if they are infinite or the value is not observable. Unit: 1.
   */
  degrees_of_freedom: number | null;
  /**
   * k for 95.45 %; null if not observable. Unit: 1.
   */
  coverage_factor: number | null;
  [k: string]: number | null;
}
/**
 * A combination of unknowns that changes no reading.
 */
export interface Unobservable {
  /**
   * As a sum.
   */
  combination: string;
  /**
   * In words.
   */
  words: string;
  /**
   * A set-up that makes it observable; null if none of those tried does.
   */
  resolve_with: string | null;
}
/**
 * Root mean squares of the residual.
 */
export interface RmsEntries {
  /**
   * Of the readings that the model was fitted to.
   */
  in_sample: RmsEntry;
  /**
   * Of places that the model had not seen.
   */
  held_out: RmsEntry;
  /**
   * Of repeated readings, or the stated noise.
   */
  repeatability: RmsEntry;
  /**
   * Without the unknown errors, set-up only.
   */
  without_model: RmsEntry;
}
/**
 * A root mean square.
 */
export interface RmsEntry {
  /**
   * Of lengths, µm; null without such readings.
   */
  um: number | null;
  /**
   * Of angles, µrad; null without such readings.
   */
  urad: number | null;
  /**
   * In units of the stated noise. Unit: 1.
   */
  times_noise: number;
}
/**
 * The feeds of a campaign; empty if none is stated.
 */
export interface Feeds {
  /**
   * Every feed, the slowest first.
   */
  counts: FeedCount[];
  /**
   * Lags that these readings cannot separate from errors of the machine or the set-up.
   */
  not_separable: SharedLag[];
}
/**
 * Readings at one feed.
 */
export interface FeedCount {
  /**
   * Feed of the tool against the workpiece, mm/min; 0 standing.
   */
  feed_mm_per_min: number;
  /**
   * How many readings.
   */
  readings: number;
}
/**
 * What lag of one axis cannot be separated from.
 */
export interface SharedLag {
  /**
   * `lag Y`.
   */
  name: string;
  /**
   * The share of its effect on the readings that other errors have too, 0 to 1. Unit: 1.
   */
  share: number;
  /**
   * The errors for which it passes, the largest first.
   */
  passes_for: PassesFor[];
}
/**
 * An error for which lag passes.
 */
export interface PassesFor {
  /**
   * Its name.
   */
  name: string;
  /**
   * How much of it 1 ms of lag pretends. Unit: that of `unit`.
   */
  per_ms: number;
  /**
   * `um` or `urad`.
   */
  unit: string;
}
/**
 * The test of the residual against noise or repeatability.
 */
export interface TestEntry {
  /**
   * `chi-square` against the stated noise, or `F` against repeated readings.
   */
  statistic: string;
  /**
   * Its value. Unit: 1.
   */
  value: number;
  /**
   * What it exceeds by chance, at this level; null without degrees of freedom. Unit: 1.
   */
  limit: number | null;
  /**
   * How often a good campaign exceeds it. Unit: 1.
   */
  level: number;
  /**
   * Degrees of freedom of the residual. Unit: 1.
   */
  degrees_of_freedom: number;
  /**
   * Those of the repeatability; null for `chi-square`. Unit: 1.
   */
  degrees_of_freedom_of_repeats: number | null;
}
/**
 * A part of the residual.
 */
export interface IdentifyErrorsFieldEntry {
  /**
   * The letter of an axis, `arrangement` (location errors), `approach` or `time`.
   */
  what: string;
  /**
   * The share of the squares of the residual that this kind of error, which is not listed, would explain alone,
   * 0 to 1. Unit: 1.
   */
  share: number;
}
/**
 * How well readings are predicted, by all errors together.
 */
export interface PredictionEntry {
  /**
   * On the readings themselves.
   */
  in_sample: RmsEntry;
  /**
   * On readings that were held out.
   */
  held_out: HeldOutEntry[];
}
/**
 * Readings that were predicted without them.
 */
export interface HeldOutEntry {
  /**
   * The rotary axis of which one angle after the other was held out; null: a part of the places.
   */
  axis: string | null;
  /**
   * How many parts.
   */
  parts: number;
  /**
   * The residual by the listed errors alone.
   */
  listed: RmsEntry;
  /**
   * The residual by all errors, listed or not.
   */
  all: RmsEntry;
}
/**
 * How the terms were selected.
 */
export interface SelectionEntry {
  /**
   * Number of candidate terms.
   */
  candidates: number;
  /**
   * Least |z| of a term that is kept; null if none is. Unit: 1.
   */
  least_z: number | null;
  /**
   * The limits that were tried.
   */
  scores: Score[];
}
/**
 * How well a threshold predicts.
 */
export interface Score {
  /**
   * Least |z| of a term that is kept; ∞ (null): none is, 0: all are. Unit: 1.
   */
  least_z: number | null;
  /**
   * Number of candidate terms that are kept.
   */
  terms: number;
  /**
   * Root mean square of the residual on parts that were held out, in units of the noise. Unit: 1.
   */
  held_out_times_noise: number;
  /**
   * The same on the readings themselves. Unit: 1.
   */
  in_sample_times_noise: number;
}
/**
 * A reading that does not fit.
 */
export interface IdentifyErrorsOutlierEntry {
  /**
   * Its file.
   */
  file: string;
  /**
   * Its line there.
   */
  line: number;
  /**
   * Its channel, from 1.
   */
  channel: number;
  /**
   * Its studentised residual. Unit: 1.
   */
  studentised: number;
}
/**
 * A reading and its influence on the result.
 */
export interface InfluenceEntry {
  /**
   * Its file.
   */
  file: string;
  /**
   * Its line there.
   */
  line: number;
  /**
   * Its leverage, 0 to 1. Unit: 1.
   */
  leverage: number;
  /**
   * Cook's distance; null if the result depends on this reading alone. Unit: 1.
   */
  cook: number | null;
}
/**
 * The conventions that were tried.
 */
export interface ConventionCheck {
  /**
   * Number of changes tried.
   */
  tried: number;
  /**
   * The residual as the readings are, in units of the noise. Unit: 1.
   */
  residual_times_noise: number;
  /**
   * Changes that fit far better, the best first.
   */
  better: Convention[];
  /**
   * What cannot be checked, or what to look at.
   */
  remarks: string[];
}
/**
 * A change of convention that fits far better.
 */
export interface Convention {
  /**
   * What to change, in words.
   */
  change: string;
  /**
   * The residual without the change, in units of the noise. Unit: 1.
   */
  before_times_noise: number;
  /**
   * The residual with the change, in units of the noise. Unit: 1.
   */
  after_times_noise: number;
}
/**
 * The coefficient of expansion and the error table of a scale.
 */
export interface IdentifyExpansion {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The letter of its axis, where it is stated.
   */
  axis?: string | null;
  /**
   * The coefficient of expansion by least squares over all runs, µm/(m·K).
   */
  expansion_um_per_m_k: number;
  /**
   * Its standard uncertainty, µm/(m·K).
   */
  u_um_per_m_k: number;
  /**
   * The coefficient from the slopes of the coldest and the warmest run alone, µm/(m·K).
   */
  slope_difference_um_per_m_k: number;
  /**
   * Standard deviation of the residual error, µm.
   */
  residual_um: number;
  /**
   * Materials of scales that the coefficient allows within ± 2 u.
   */
  materials: string[];
  /**
   * The runs.
   */
  runs: RunEntry[];
  /**
   * The temperature of the scale at which the error table holds, °C.
   */
  table_temperature_celsius: number;
  /**
   * The error table: actual − nominal, as the laser reads it.
   */
  table: TableRow[];
  /**
   * The cubic spline through the table (not-a-knot), piece by piece.
   */
  spline: PieceRow[];
  /**
   * What the reader should know.
   */
  warnings: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A run of the laser.
 */
export interface RunEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * The temperature of the scale, °C.
   */
  temperature_celsius: number;
  /**
   * The slope of its straight line, µm/m.
   */
  slope_um_per_m: number;
}
/**
 * A row of the error table.
 */
export interface TableRow {
  /**
   * The position, mm.
   */
  position_mm: number;
  /**
   * The positioning error, µm.
   */
  error_um: number;
  /**
   * Its standard uncertainty, µm.
   */
  u_um: number;
}
/**
 * A piece of the spline: with h = position − from, e = ((a·h + b)·h + c)·h + d, µm.
 */
export interface PieceRow {
  /**
   * Where it begins, mm.
   */
  from_mm: number;
  /**
   * Where it ends, mm.
   */
  to_mm: number;
  /**
   * a, µm/mm³.
   */
  a_um_per_mm3: number;
  /**
   * b, µm/mm².
   */
  b_um_per_mm2: number;
  /**
   * c, µm/mm.
   */
  c_um_per_mm: number;
  /**
   * d, µm.
   */
  d_um: number;
}
/**
 * Several scales.
 */
export interface IdentifyExpansions {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify-expansions/1";
  /**
   * Each of them.
   */
  scales: ExpansionDocument[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The coefficient of expansion and the error table of a scale.
 */
export interface ExpansionDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The letter of its axis, where it is stated.
   */
  axis?: string | null;
  /**
   * The coefficient of expansion by least squares over all runs, µm/(m·K).
   */
  expansion_um_per_m_k: number;
  /**
   * Its standard uncertainty, µm/(m·K).
   */
  u_um_per_m_k: number;
  /**
   * The coefficient from the slopes of the coldest and the warmest run alone, µm/(m·K).
   */
  slope_difference_um_per_m_k: number;
  /**
   * Standard deviation of the residual error, µm.
   */
  residual_um: number;
  /**
   * Materials of scales that the coefficient allows within ± 2 u.
   */
  materials: string[];
  /**
   * The runs.
   */
  runs: RunEntry[];
  /**
   * The temperature of the scale at which the error table holds, °C.
   */
  table_temperature_celsius: number;
  /**
   * The error table: actual − nominal, as the laser reads it.
   */
  table: TableRow[];
  /**
   * The cubic spline through the table (not-a-knot), piece by piece.
   */
  spline: PieceRow[];
  /**
   * What the reader should know.
   */
  warnings: string[];
}
/**
 * `trueaxis/identify-probe-programs/1`.
 */
export interface IdentifyProbePrograms {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify-probe-programs/1";
  /**
   * Programs, subprograms and masks.
   */
  files: ProbeProgramEntry[];
  /**
   * The table of corrections that the control applies; null: hits as they are.
   */
  table: IdentifyProbeProgramsTableEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * One file.
 */
export interface ProbeProgramEntry {
  /**
   * Its name in the folder.
   */
  file: string;
  /**
   * What it is for.
   */
  purpose: string;
  /**
   * How many hits it makes; null: it is no program of its own.
   */
  hits: number | null;
  /**
   * How far its stations, read back, lie from those that are wanted, µm; null: it is not run alone.
   */
  off_stations_um: number | null;
}
/**
 * The table inside the control.
 */
export interface IdentifyProbeProgramsTableEntry {
  /**
   * Directions.
   */
  directions: number;
  /**
   * Greatest less smallest correction, µm.
   */
  range_um: number;
  /**
   * What the straight lines between the directions leave at most of the calibration, µm.
   */
  interpolation_um: number;
  /**
   * The largest standard uncertainty of a correction, µm.
   */
  u_um: number;
  /**
   * The length of the probe that is subtracted on the plane face, mm; null: it is not known.
   */
  length_mm: number | null;
}
/**
 * The calibration of a touch probe.
 */
export interface IdentifyProbe {
  /**
   * Its name.
   */
  stylus?: string;
  /**
   * Range of the radii as measured, µm.
   */
  range_before_um?: number;
  /**
   * The same with only the offset corrected, µm.
   */
  range_offset_only_um?: number;
  /**
   * The same corrected, µm.
   */
  range_after_um?: number;
  /**
   * The same corrected, directions held out, µm.
   */
  range_held_out_um?: number;
  /**
   * Root mean square as measured, µm.
   */
  rms_before_um?: number;
  /**
   * The same corrected, µm.
   */
  rms_after_um?: number;
  /**
   * The same corrected, directions held out, µm.
   */
  rms_held_out_um?: number;
  /**
   * The least and the greatest measured radius, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  radius_before_mm?: [number, number];
  /**
   * Ball − spindle with the spindle at 0, mm; null if not observable.
   */
  offset_mm?: number[] | null;
  /**
   * Its standard uncertainties, mm.
   */
  u_offset_mm?: number[] | null;
  /**
   * Centre of the gauge, mm.
   */
  centre_mm?: number[];
  /**
   * Whether that is stated.
   */
  centre_known?: boolean;
  /**
   * By how much an offset from four hits alone differs, µm.
   *
   * @minItems 2
   * @maxItems 2
   */
  four_hit_bias_um?: [number, number];
  /**
   * The model of the pre-travel: `fourier` or `spline`.
   */
  model?: string;
  /**
   * Its highest harmonic, or its number of knots.
   */
  size?: number;
  /**
   * Harmonics of the pre-travel; the first is part of the offset.
   */
  harmonics?: HarmonicEntry[];
  /**
   * The sizes of model that were tried.
   */
  scores?: ProbeScoreEntry[];
  /**
   * Number of hits.
   */
  hits?: number;
  /**
   * Standard deviation of one hit, µm.
   */
  s_um?: number;
  /**
   * Degrees of freedom of the fit.
   */
  degrees_of_freedom?: number;
  /**
   * Factor from u to U (95 %). Unit: 1.
   */
  coverage_factor?: number;
  /**
   * Orientations of the spindle, degrees.
   */
  orientations_deg?: number[];
  /**
   * Widest gap between directions, degrees.
   */
  widest_gap_deg?: number;
  /**
   * Repeated hits; null if there are none.
   */
  repeatability?: RepeatsEntry | null;
  /**
   * Form error after ISO 230-10; null if the hits do not allow it.
   */
  iso230_10?: FormEntry | null;
  /**
   * Fresh hits that were not used in the fit; null if there are none.
   */
  check?: FreshCheckEntry | null;
  /**
   * Orientation of the spindle for the table below, degrees.
   */
  table_orientation_deg?: number;
  /**
   * Deviations by direction of motion.
   */
  table?: DirectionEntry[];
  /**
   * Deviation of each hit as measured, µm.
   */
  deviations_um?: number[];
  /**
   * Residual of each hit, µm.
   */
  left_um?: number[];
  /**
   * Residual of each hit, its direction held out, µm.
   */
  held_out_um?: number[];
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify-probe/1";
  /**
   * Name of the study.
   */
  name: string;
  /**
   * The dial gauge on the turning ball; null if not measured.
   */
  eccentricity: EccentricityEntry | null;
  /**
   * The length of the probe; null if not measured.
   */
  z_datum: ZDatumEntry | null;
  /**
   * The plain calibration with four hits; null if not measured.
   */
  xy_datum: XyDatum | null;
  /**
   * The results of all styli.
   */
  styli: StylusEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A harmonic of the pre-travel.
 */
export interface HarmonicEntry {
  /**
   * Its order.
   */
  order: number;
  /**
   * Power of the sine of the latitude (spheres).
   */
  axial: number;
  /**
   * Its amplitude, µm.
   */
  amplitude_um: number;
  /**
   * Direction of its first lobe, degrees.
   */
  phase_deg: number;
  /**
   * Its cosine term, µm.
   */
  cosine_um: number;
  /**
   * Its sine term, µm.
   */
  sine_um: number;
  /**
   * Standard uncertainty of each of the two, µm.
   */
  u_um: number;
}
/**
 * One size of model.
 */
export interface ProbeScoreEntry {
  /**
   * `fourier` or `spline`.
   */
  model: string;
  /**
   * Its highest harmonic, or its number of knots.
   */
  size: number;
  /**
   * Number of its parameters.
   */
  parameters: number;
  /**
   * Root mean square of the residual in sample, µm.
   */
  rms_in_um: number;
  /**
   * The same with directions held out, µm.
   */
  rms_held_out_um: number;
  /**
   * Whether it was chosen.
   */
  chosen: boolean;
}
/**
 * Repeated hits.
 */
export interface RepeatsEntry {
  /**
   * Number of directions with repeated hits.
   */
  directions: number;
  /**
   * Their standard deviation, µm.
   */
  s_um: number;
  /**
   * Their largest range, µm.
   */
  range_um: number;
}
/**
 * A form error after ISO 230-10.
 */
export interface FormEntry {
  /**
   * Its symbol.
   */
  figure: string;
  /**
   * The number of hits that the standard asks for.
   */
  hits_of_the_standard: number;
  /**
   * As measured, µm.
   */
  before_um: number;
  /**
   * Corrected, µm.
   */
  after_um: number;
  /**
   * Whether the clause was checked in the text of the standard.
   */
  checked_on_the_page: boolean;
}
/**
 * Fresh hits that were not used in the fit.
 */
export interface FreshCheckEntry {
  /**
   * Number of hits.
   */
  hits: number;
  /**
   * As measured.
   */
  before: SpreadEntry;
  /**
   * Corrected.
   */
  after: SpreadEntry;
  /**
   * Share of the hits within U (95 %), 0 to 1. Unit: 1.
   */
  within_U: number;
}
/**
 * The spread of radii.
 */
export interface SpreadEntry {
  /**
   * Greatest − least, µm.
   */
  range_um: number;
  /**
   * Root mean square, µm.
   */
  rms_um: number;
}
/**
 * The deviation in one direction of motion.
 */
export interface DirectionEntry {
  /**
   * The direction of motion, degrees.
   */
  angle_deg: number;
  /**
   * Deviation along it, µm.
   */
  dR_um: number;
  /**
   * Its part in X, µm.
   */
  dX_um: number;
  /**
   * Its part in Y, µm.
   */
  dY_um: number;
  /**
   * Its standard uncertainty, µm.
   */
  u_um: number;
}
/**
 * The dial gauge on the turning ball.
 */
export interface EccentricityEntry {
  /**
   * Ball − spindle in x and y, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  offset_mm: [number, number];
  /**
   * Its standard uncertainties, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  u_offset_mm: [number, number];
  /**
   * Run-out of the ball, µm.
   */
  runout_um: number;
  /**
   * Root mean square of the residual, µm.
   */
  left_rms_um: number;
}
/**
 * The length of the probe.
 */
export interface ZDatumEntry {
  /**
   * Height of the ring, mm.
   */
  ring_top_mm: number;
  /**
   * Length of the probe, mm.
   */
  length_mm: number;
  /**
   * Its standard uncertainty, mm.
   */
  u_length_mm: number;
  /**
   * Range of the triggers, µm.
   */
  range_um: number;
}
/**
 * What a control takes over from four hits.
 */
export interface XyDatum {
  /**
   * Ball − spindle in x and y, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  offset_mm: [number, number];
  /**
   * The effective diameters of the ball in x and y, less the pre-travel, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  ball_diameter_mm: [number, number];
}
/**
 * The results of one stylus.
 */
export interface StylusEntry {
  /**
   * Its name.
   */
  stylus: string;
  /**
   * Range of the radii as measured, µm.
   */
  range_before_um: number;
  /**
   * The same with only the offset corrected, µm.
   */
  range_offset_only_um: number;
  /**
   * The same corrected, µm.
   */
  range_after_um: number;
  /**
   * The same corrected, directions held out, µm.
   */
  range_held_out_um: number;
  /**
   * Root mean square as measured, µm.
   */
  rms_before_um: number;
  /**
   * The same corrected, µm.
   */
  rms_after_um: number;
  /**
   * The same corrected, directions held out, µm.
   */
  rms_held_out_um: number;
  /**
   * The least and the greatest measured radius, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  radius_before_mm: [number, number];
  /**
   * Ball − spindle with the spindle at 0, mm; null if not observable.
   */
  offset_mm: number[] | null;
  /**
   * Its standard uncertainties, mm.
   */
  u_offset_mm: number[] | null;
  /**
   * Centre of the gauge, mm.
   */
  centre_mm: number[];
  /**
   * Whether that is stated.
   */
  centre_known: boolean;
  /**
   * By how much an offset from four hits alone differs, µm.
   *
   * @minItems 2
   * @maxItems 2
   */
  four_hit_bias_um: [number, number];
  /**
   * The model of the pre-travel: `fourier` or `spline`.
   */
  model: string;
  /**
   * Its highest harmonic, or its number of knots.
   */
  size: number;
  /**
   * Harmonics of the pre-travel; the first is part of the offset.
   */
  harmonics: HarmonicEntry[];
  /**
   * The sizes of model that were tried.
   */
  scores: ProbeScoreEntry[];
  /**
   * Number of hits.
   */
  hits: number;
  /**
   * Standard deviation of one hit, µm.
   */
  s_um: number;
  /**
   * Degrees of freedom of the fit.
   */
  degrees_of_freedom: number;
  /**
   * Factor from u to U (95 %). Unit: 1.
   */
  coverage_factor: number;
  /**
   * Orientations of the spindle, degrees.
   */
  orientations_deg: number[];
  /**
   * Widest gap between directions, degrees.
   */
  widest_gap_deg: number;
  /**
   * Repeated hits; null if there are none.
   */
  repeatability: RepeatsEntry | null;
  /**
   * Form error after ISO 230-10; null if the hits do not allow it.
   */
  iso230_10: FormEntry | null;
  /**
   * Fresh hits that were not used in the fit; null if there are none.
   */
  check: FreshCheckEntry | null;
  /**
   * Orientation of the spindle for the table below, degrees.
   */
  table_orientation_deg: number;
  /**
   * Deviations by direction of motion.
   */
  table: DirectionEntry[];
  /**
   * Deviation of each hit as measured, µm.
   */
  deviations_um: number[];
  /**
   * Residual of each hit, µm.
   */
  left_um: number[];
  /**
   * Residual of each hit, its direction held out, µm.
   */
  held_out_um: number[];
}
/**
 * `trueaxis/identify-rtcp-programs/1`.
 */
export interface IdentifyRtcpPrograms {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify-rtcp-programs/1";
  /**
   * The programs.
   */
  programs: IdentifyRtcpProgramsProgramEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * One program.
 */
export interface IdentifyRtcpProgramsProgramEntry {
  /**
   * Its file in the folder.
   */
  file: string;
  /**
   * The set of readings.
   */
  set: string;
  /**
   * How far its poses, read back, lie from those of the set, µm.
   */
  off_poses_um: number;
}
/**
 * An RTCP calibration.
 */
export interface IdentifyRtcp {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify-rtcp/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * Which rotary axes carry the tool and which the workpiece.
   */
  topology: string;
  /**
   * The offsets of the rotary axes in chain order.
   */
  offsets: OffsetEntry[];
  /**
   * Whether the directions of the rotary axes were unknowns beside the offsets.
   */
  angles_found: boolean;
  /**
   * The angle errors of the rotary axes.
   */
  angles: AngleEntry[];
  /**
   * What the segments of a path with tool-centre point keep; null if the file has no `[segments]`.
   */
  segments: SegmentsEntry | null;
  /**
   * The RTCP screen of the i5 control, field by field; empty for other controls.
   */
  screen: ScreenEntry[];
  /**
   * The control whose numbers follow; null if none is stated.
   */
  control: string | null;
  /**
   * The numbers of the control.
   */
  numbers: NumberEntry[];
  /**
   * Offsets that no number of the control takes in.
   */
  without_number: string[];
  /**
   * Combinations of offsets that change no reading.
   */
  unobservable: Unseen[];
  /**
   * How many numbers were read.
   */
  readings: number;
  /**
   * χ² of the readings. Unit: 1.
   */
  chi_square: number;
  /**
   * Its degrees of freedom.
   */
  degrees_of_freedom: number;
  /**
   * By how much the uncertainties are enlarged, 1 or more. Unit: 1.
   */
  birge: number;
  /**
   * Root mean square of the residual, µm.
   */
  rms_residual_um: number;
  /**
   * The reading that fits worst.
   */
  worst_reading: WorstEntry | null;
  /**
   * Wrong signs that would explain a bad fit.
   */
  suspicions: string[];
  /**
   * The tip before and after; null if not all offsets are known.
   */
  forecast: ForecastEntry | null;
  /**
   * The result in one sentence.
   */
  verdict: string;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * One offset of a rotary axis.
 */
export interface OffsetEntry {
  /**
   * Its ISO 230-1 name.
   */
  name: string;
  /**
   * The same in words.
   */
  words: string;
  /**
   * True − machine file, µm; null if no reading determines it.
   */
  value_um: number | null;
  /**
   * Its standard uncertainty, µm.
   */
  u_um: number | null;
}
/**
 * One angle error of a rotary axis.
 */
export interface AngleEntry {
  /**
   * Its ISO 230-1 name.
   */
  name: string;
  /**
   * The same in words.
   */
  words: string;
  /**
   * Its value, µrad; null where it was not asked for or is not observable.
   */
  value_urad: number | null;
  /**
   * Its expanded uncertainty (k = 2), µrad.
   */
  U_urad: number | null;
  /**
   * Whether these readings determine it.
   */
  observable: boolean;
  /**
   * The expanded uncertainty (k = 2) that these readings give by their stated noise, µrad; null: none.
   */
  U_expected_urad: number | null;
  /**
   * Which further reading would determine it; null where these do.
   */
  further_reading: string | null;
}
/**
 * What the segments of a path keep.
 */
export interface SegmentsEntry {
  /**
   * The largest chord error, µm.
   */
  chord_error_um: number;
  /**
   * The largest distance of the path from a rotary axis, mm.
   */
  distance_mm: number;
  /**
   * The largest step of one rotary axis while the tip stands still, degrees.
   */
  largest_step_deg: number;
  /**
   * By how much the rotary axes together turn for each mm where the path turns most, deg/mm. Unit: deg/mm.
   */
  sharpest_deg_per_mm: number | null;
  /**
   * The longest segment there, mm.
   */
  longest_segment_mm: number | null;
  /**
   * The shortest segment of the control, mm, if stated.
   */
  shortest_segment_mm: number | null;
  /**
   * The turning that it allows, deg/mm. Unit: deg/mm.
   */
  shortest_allows_deg_per_mm: number | null;
  /**
   * The first segment of the control, mm, if stated.
   */
  first_segment_mm: number | null;
  /**
   * The turning that it allows, deg/mm. Unit: deg/mm.
   */
  first_allows_deg_per_mm: number | null;
}
/**
 * One field of the RTCP screen.
 */
export interface ScreenEntry {
  /**
   * Its name in English.
   */
  name: string;
  /**
   * Its name as it is printed.
   */
  printed: string;
  /**
   * Its unit; `--` where the screen states none.
   */
  unit: string;
  /**
   * What the picture of the paper shows.
   */
  picture: string;
  /**
   * What to enter; null where neither paper nor readings determine it.
   */
  enter: string | null;
  /**
   * Why, or why not.
   */
  words: string;
}
/**
 * One number of the control.
 */
export interface NumberEntry {
  /**
   * Its name at the control.
   */
  name: string;
  /**
   * What it means.
   */
  words: string;
  /**
   * As it is entered today, mm.
   */
  old_mm: number;
  /**
   * As it is to be entered, mm; null if no reading determines it.
   */
  new_mm: number | null;
  /**
   * Standard uncertainty of the new one, µm.
   */
  u_um: number | null;
  /**
   * Whether the offsets change it at all.
   */
  changes: boolean;
}
/**
 * A combination of offsets that changes no reading.
 */
export interface Unseen {
  /**
   * As a sum.
   */
  combination: string;
  /**
   * What that means.
   */
  words: string;
}
/**
 * The reading that fits worst.
 */
export interface WorstEntry {
  /**
   * File of the reading.
   */
  file: string;
  /**
   * Its line there.
   */
  line: number;
  /**
   * Its direction: x, y or z.
   */
  channel: string;
  /**
   * Reading − model, µm.
   */
  residual_um: number;
  /**
   * The same in its standard uncertainty. Unit: 1.
   */
  standardised: number;
  /**
   * Whether that is more than chance.
   */
  is_outlier: boolean;
}
/**
 * The tip over all poses, before and after.
 */
export interface ForecastEntry {
  /**
   * How many poses.
   */
  poses: number;
  /**
   * With the old numbers.
   */
  before: StraysEntry;
  /**
   * With the new numbers as entered, if the centres are right.
   */
  after: StraysEntry;
  /**
   * Expanded uncertainty (k = 2) at the worst pose, µm.
   */
  U_after_um: number;
  /**
   * The root mean square to be expected, µm.
   */
  expected_rms_um: number;
}
/**
 * How far the tip strays.
 */
export interface StraysEntry {
  /**
   * The longest deviation, µm.
   */
  worst_um: number;
  /**
   * The root mean square of all, µm.
   */
  rms_um: number;
  /**
   * The rotary axes at the longest deviation, degrees.
   */
  at_deg: {
    [k: string]: number;
  };
}
/**
 * Deviations of a surface from the hits of a probing program.
 */
export interface IdentifySurface {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify-surface/1";
  /**
   * Name of the study.
   */
  name: string;
  /**
   * Whether a virtual machine made the hits.
   */
  virtual: boolean;
  /**
   * The number of the probe in the control.
   */
  tool: number;
  /**
   * The stylus of the calibration.
   */
  stylus: string;
  /**
   * Number of hits in the log.
   */
  hits: number;
  /**
   * Number of hits that were planned.
   */
  planned: number;
  /**
   * The touch at the end less the first one at the same point, µm; null if there is none.
   */
  drift_um: number | null;
  /**
   * Points without a hit.
   */
  lost: number[];
  /**
   * The points with their deviations.
   */
  points: DeviationEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A point of the surface.
 */
export interface DeviationEntry {
  /**
   * Its number in the table of points.
   */
  point: number;
  /**
   * The nominal point, workpiece frame, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  point_mm: [number, number, number];
  /**
   * The normal there, out of the material. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  normal: [number, number, number];
  /**
   * Along the normal, positive where there is more material, µm.
   */
  deviation_um: number;
  /**
   * Its expanded uncertainty (k = 2), µm.
   */
  U_um: number;
  /**
   * With the nominal machine and the ball radius alone, µm.
   */
  as_read_um: number;
  /**
   * What the errors of the machine did, µm.
   */
  by_machine_um: number;
  /**
   * What offset and pre-travel of the probe did, µm.
   */
  by_probe_um: number;
  /**
   * What the drift did, µm.
   */
  by_drift_um: number;
  /**
   * Standard uncertainty: one trigger, µm.
   */
  u_repeatability_um: number;
  /**
   * Standard uncertainty: calibration of the probe, µm.
   */
  u_calibration_um: number;
  /**
   * Standard uncertainty: length of the probe, µm.
   */
  u_length_um: number;
  /**
   * Standard uncertainty: errors of the machine, µm.
   */
  u_machine_um: number;
  /**
   * Standard uncertainty: drift, µm.
   */
  u_drift_um: number;
  /**
   * Its line in the log.
   */
  line: number;
}
/**
 * Error tables of a machine.
 */
export interface IdentifyTables {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify-tables/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The tables of error motions, axis by axis.
   */
  tables: FoundTable[];
  /**
   * The squarenesses from circles.
   */
  squarenesses: FoundSquareness[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The table of one error motion; of the body, as in the machine file.
 */
export interface FoundTable {
  /**
   * The error by its name of ISO 230-1.
   */
  error: string;
  /**
   * `um` or `urad`: the unit of its values.
   */
  unit: string;
  /**
   * How many runs in each direction.
   */
  runs: number;
  /**
   * Standard deviation of a single reading, µm or µrad; null where each target was read once. Unit: that of `unit`.
   */
  scatter: number | null;
  /**
   * What the set-up of the instrument hides, and was subtracted.
   */
  removed: string;
  /**
   * What the angles of the axis did to the readings over the arm of the optics.
   */
  arms: ArmEntry[];
  /**
   * Largest − least of the mean of both directions, µm or µrad. Unit: that of `unit`.
   */
  range: number;
  /**
   * How far the instrument would read otherwise on the new machine, µm or µrad. Unit: that of `unit`.
   */
  read_back: number;
  /**
   * Its rows.
   */
  rows: FoundRow[];
}
/**
 * What an angle did over the arm.
 */
export interface ArmEntry {
  /**
   * The angular error.
   */
  error: string;
  /**
   * At most, µm.
   */
  most_um: number;
}
/**
 * A row of a table.
 */
export interface FoundRow {
  /**
   * The position. Unit: mm or deg.
   */
  position: number;
  /**
   * Reached upwards, µm or µrad. Unit: that of `unit`.
   */
  up: number;
  /**
   * Reached downwards, µm or µrad; equal to `up` where one direction was read. Unit: that of `unit`.
   */
  down: number;
  /**
   * Standard uncertainty, µm or µrad. Unit: that of `unit`.
   */
  u: number;
}
/**
 * A squareness.
 */
export interface FoundSquareness {
  /**
   * The location error that states it.
   */
  error: string;
  /**
   * Its value, µrad.
   */
  value_urad: number;
  /**
   * Its standard uncertainty, µrad.
   */
  u_urad: number;
  /**
   * The two axes.
   *
   * @minItems 2
   * @maxItems 2
   */
  axes: [string, string];
  /**
   * The angle by which the axes are closer than 90°, as read, µrad.
   */
  read_urad: number;
  /**
   * The same on the machine with its new tables and its old location error, µrad.
   */
  before_urad: number;
  /**
   * The first axis longer than the second over the diameter, read − tables, µm.
   */
  scale_difference_um: number;
}
/**
 * A thermal model of one error, from logs of temperatures and displacements.
 */
export interface IdentifyThermal {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify/1";
  /**
   * Which form of it: `thermal`.
   */
  what: "thermal";
  /**
   * Name of the study.
   */
  name: string;
  /**
   * The error, such as `EZ0t`.
   */
  error: string;
  /**
   * Where the displacement is zero: `cycle`, `start` or `common`.
   */
  zero: string;
  /**
   * `model` or `refused`.
   */
  verdict: string;
  /**
   * Why the model is refused; null if it is not.
   */
  refusal: string | null;
  /**
   * Share of the mean square drift of held-out cycles that the model explains, at most 1. Unit: 1.
   */
  explained: number;
  /**
   * Root mean square without a model, µm.
   */
  no_model_um: number;
  /**
   * Root mean square of the residual on the rows of the fit, µm.
   */
  in_sample_um: number;
  /**
   * The same with single rows held out, µm.
   */
  row_wise_um: number;
  /**
   * The same with whole cycles held out, µm.
   */
  held_out_um: number;
  /**
   * The same, counted from the first row of each cycle, µm.
   */
  held_out_since_start_um: number;
  /**
   * Standard uncertainty of one reading, µm.
   */
  repeatability_um: number;
  /**
   * Whether it is stated; if not, it comes from neighbouring readings.
   */
  repeatability_stated: boolean;
  /**
   * Number of terms of the chosen model.
   */
  chosen_terms: number;
  /**
   * The coefficients of the chosen model.
   */
  coefficients: CoefficientEntry[];
  /**
   * Correlations of the coefficients, −1 to 1, row by row. Unit: 1.
   */
  correlation: number[][];
  /**
   * The displacement where all sensors read the reference, µm; null if the zero is free.
   */
  intercept_um: number | null;
  /**
   * Where the model is zero, °C.
   */
  reference_celsius: number;
  /**
   * The models tried, from no term on.
   */
  scores: ThermalScoreEntry[];
  /**
   * The model of all terms at once.
   */
  all_terms: ThermalScoreEntry;
  /**
   * The cycles.
   */
  cycles: CycleEntry[];
  /**
   * The lines for the machine file; null if there are none.
   */
  machine_file: string | null;
  /**
   * Why there are no such lines; else null.
   */
  no_machine_file_because: string | null;
  /**
   * What to observe when the model is used.
   */
  warnings: string[];
  /**
   * How later logs agree with it; null without later logs.
   */
  later: ScoringEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A coefficient.
 */
export interface CoefficientEntry {
  /**
   * The sensor.
   */
  sensor: string;
  /**
   * Time constant of its lag, s; null without lag.
   */
  lag_s: number | null;
  /**
   * The coefficient, µm/K.
   */
  um_per_k: number;
  /**
   * Its standard uncertainty, µm/K.
   */
  u_um_per_k: number;
  /**
   * The least and the greatest temperature in the logs, °C.
   *
   * @minItems 2
   * @maxItems 2
   */
  range_celsius: [number, number];
}
/**
 * How well a model of some terms does.
 */
export interface ThermalScoreEntry {
  /**
   * Its terms.
   */
  terms: TermEntry[];
  /**
   * Root mean square of the residual on the rows of the fit, µm.
   */
  in_sample_um: number;
  /**
   * The same with single rows held out, µm.
   */
  row_wise_um: number;
  /**
   * The same with whole cycles held out, µm.
   */
  held_out_um: number;
  /**
   * Its square, µm².
   */
  held_out_um2: number;
  /**
   * Standard uncertainty of the square, µm².
   */
  u_held_out_um2: number;
  /**
   * Root mean square of each cycle, held out, µm.
   */
  by_cycle_um: number[];
  /**
   * How many times the same terms were chosen with one cycle held out.
   */
  chosen_again: number;
  /**
   * Condition number of the columns; null if they are linearly dependent. Unit: 1.
   */
  condition: number | null;
}
/**
 * A term of a model.
 */
export interface TermEntry {
  /**
   * The sensor.
   */
  sensor: string;
  /**
   * Time constant of its lag, s; null without lag.
   */
  lag_s: number | null;
}
/**
 * A cycle of the logs.
 */
export interface CycleEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Number of its rows.
   */
  rows: number;
  /**
   * Root mean square without a model, µm.
   */
  no_model_um: number;
  /**
   * Root mean square of the residual, predicted without this cycle, µm.
   */
  held_out_um: number;
}
/**
 * How later logs agree with the model.
 */
export interface ScoringEntry {
  /**
   * `as promised` or `worse than promised`.
   */
  verdict: string;
  /**
   * What the model left of whole cycles that it had not seen, rms, µm.
   */
  promised_um: number;
  /**
   * Expanded uncertainty of a row within the pattern of the sensors, 95.45 %, µm.
   */
  promised_u_um: number;
  /**
   * The factor of U (Student's t). Unit: 1.
   */
  coverage_factor: number;
  /**
   * Degrees of freedom of the factor: cycles less one.
   */
  degrees_of_freedom: number;
  /**
   * A row with a larger squared distance is outside the pattern. Unit: 1.
   */
  row_limit: number;
  /**
   * A log with a larger mean of it is outside the pattern. Unit: 1.
   */
  log_limit: number;
  /**
   * The later logs.
   */
  logs: ScoredLogEntry[];
}
/**
 * A later log.
 */
export interface ScoredLogEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * `as promised` or `worse than promised`.
   */
  verdict: string;
  /**
   * Number of its rows.
   */
  rows: number;
  /**
   * Of the displacement without a model, rms, µm.
   */
  no_model_um: number;
  /**
   * Of the residual after its zero is removed, rms, µm.
   */
  left_um: number;
  /**
   * The largest residual with its sign, µm.
   */
  largest_um: number;
  /**
   * Of the expanded uncertainty of the rows, which grows outside the pattern, rms, µm.
   */
  u_um: number;
  /**
   * Share of the rows whose residual is within their U. Unit: 1.
   */
  within_u: number;
  /**
   * Whether the sensors moved as in the logs of the model: `inside`, `partly outside` or `outside`.
   */
  pattern: string;
  /**
   * Rows outside the pattern.
   */
  rows_outside: number;
  /**
   * Mean squared distance of the rows from the pattern (Mahalanobis). Unit: 1.
   */
  mean_distance: number;
  /**
   * How much warmer all sensors together are than in the mean of the logs of the model, K.
   */
  warmer_k: number;
  /**
   * Logs of the same pattern are within this, K; null if one zero holds for all logs.
   */
  warmer_limit_k: number | null;
  /**
   * Squared distance of each row. Unit: 1.
   */
  distances: number[];
  /**
   * Expanded uncertainty of each row, µm.
   */
  row_u_um: number[];
  /**
   * Residual of each row, µm.
   */
  row_left_um: number[];
  /**
   * Sensors beyond their range.
   */
  sensors_outside: SensorOutsideEntry[];
  /**
   * Sensors that are not where the others say, in the farthest row.
   */
  combinations: CombinationEntry[];
}
/**
 * A sensor beyond its range.
 */
export interface SensorOutsideEntry {
  /**
   * The sensor.
   */
  sensor: string;
  /**
   * Here, °C.
   *
   * @minItems 2
   * @maxItems 2
   */
  range_celsius: [number, number];
  /**
   * In the logs of the model, °C.
   *
   * @minItems 2
   * @maxItems 2
   */
  logged_celsius: [number, number];
  /**
   * From its zero, K.
   *
   * @minItems 2
   * @maxItems 2
   */
  moved_k: [number, number];
  /**
   * From its zero in the logs of the model, K.
   *
   * @minItems 2
   * @maxItems 2
   */
  logged_moved_k: [number, number];
}
/**
 * A sensor that is not where the others say.
 */
export interface CombinationEntry {
  /**
   * The sensor.
   */
  sensor: string;
  /**
   * Time constant of its lag, s; null without lag.
   */
  lag_s: number | null;
  /**
   * Number of the row, from 1.
   */
  row: number;
  /**
   * How far it is from what the others say, K.
   */
  off_k: number;
  /**
   * Standard deviation of that in the logs of the model, K.
   */
  usual_k: number;
}
/**
 * Tools as they were measured.
 */
export interface IdentifyTools {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify-tools/1";
  /**
   * Whether a virtual machine wrote the log.
   */
  is_virtual: boolean;
  /**
   * The tools in the order in which they were measured.
   */
  tools: MeasuredToolEntry[];
  /**
   * How far spindle and setter have drifted since the face was calibrated, µm; null without a gauge.
   */
  drift_um: number | null;
  /**
   * Its expanded uncertainty (k = 2), µm.
   */
  U_drift_um: number | null;
  /**
   * What the uncertainties do not cover.
   */
  missing: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A tool as it was measured.
 */
export interface MeasuredToolEntry {
  /**
   * Its number.
   */
  tool: number;
  /**
   * Its name.
   */
  name: string;
  /**
   * `fit`, `not decided`, `worn` or `broken`.
   */
  state: string;
  /**
   * Its length, mm.
   */
  length_mm: number;
  /**
   * Its expanded uncertainty (k = 2), µm.
   */
  U_length_um: number;
  /**
   * Measured − nominal length, µm.
   */
  length_off_um: number;
  /**
   * Its diameter, mm; null if it was not measured.
   */
  diameter_mm: number | null;
  /**
   * Its expanded uncertainty (k = 2), µm.
   */
  U_diameter_um: number | null;
  /**
   * What stands against it.
   */
  faults: string[];
  /**
   * What cannot be decided.
   */
  doubts: string[];
}
/**
 * What a lever would leave.
 */
export interface LiveExpect {
  /**
   * Which document this is.
   */
  schema: "trueaxis/live-expect/1";
  /**
   * The name of the plan.
   */
  name: string;
  /**
   * The log.
   */
  log: string;
  /**
   * Each live axis over the whole day.
   */
  axes: ExpectedAxis[];
  /**
   * Its rows, at most 500: of a longer log the first of so many, with the largest errors of all of them.
   */
  times: ExpectedTime[];
  /**
   * What the loss of each sensor costs on that day.
   */
  losses: ExpectedLoss[];
  /**
   * Tip and tool axis together, where the control takes whole poses; there are no `axes` then. Null with a control of another kind.
   */
  poses: ExpectedPoses | null;
  /**
   * What no offset of an axis changes: the largest deviation of the tool axis over the day; null without rotary axes and
   * angular errors.
   */
  tool_axis_urad: number | null;
  /**
   * The largest deviation of the tip in the directions that no live axis corrects, and by errors that do not change with
   * the position of their axis: squareness, straightness, roll. Null where the control takes whole poses.
   */
  other_tip_um: number | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * One live axis over the day. Numbers are in `unit`.
 */
export interface ExpectedAxis {
  /**
   * Its letter.
   */
  axis: string;
  /**
   * um or urad.
   */
  unit: string;
  /**
   * The control corrects it along a line of the position.
   */
  on_line: boolean;
  /**
   * The largest error without the correction. Unit: that of `unit`.
   */
  before: number;
  /**
   * The largest error with it, standing still. Unit: that of `unit`.
   */
  after: number;
  /**
   * Of it: the temperatures have changed since the last sample. Unit: that of `unit`.
   */
  by_age: number;
  /**
   * Of it: whole increments and the dead band; where the control corrects along a line, what a line leaves besides. Unit: that
   * of `unit`.
   */
  by_increment: number;
  /**
   * More while the axis moves at its largest velocity: velocity × slope × age of the position; nothing where the control
   * corrects along a line, null where the machine file states no velocity. Unit: that of `unit`.
   */
  moving: number | null;
  /**
   * How fast the offset must change then, in the unit per second; null as above. Unit: that of `unit`.
   */
  needed_per_s: number | null;
  /**
   * How fast it must change for the temperatures alone, from one row to the next. Unit: that of `unit`.
   */
  warms_per_s: number;
  /**
   * How fast it may change. Unit: that of `unit`.
   */
  slew_per_s: number;
  /**
   * The largest offset that is needed; it is clamped at the limit. Unit: that of `unit`.
   */
  needed: number;
  /**
   * The limit of the plan. Unit: that of `unit`.
   */
  limit: number;
  /**
   * Expanded uncertainty (k = 2) of the error that is corrected, by the machine file, the largest over the day; null where it
   * states none. Unit: that of `unit`.
   */
  expanded_uncertainty: number | null;
}
/**
 * One row of the log, or the largest of some.
 */
export interface ExpectedTime {
  /**
   * In the log.
   */
  time_s: number;
  /**
   * The largest error of each live axis without the correction, in its unit. Unit: that of `unit`.
   */
  before: number[];
  /**
   * With it. Unit: that of `unit`.
   */
  after: number[];
}
/**
 * The loss of one sensor. Errors are the largest over the day and the travel, whenever it is lost; in the order of the axes, in
 * their units; of a control that takes whole poses tip (µm) and tool axis (µrad).
 */
export interface ExpectedLoss {
  /**
   * The sensor of the plan.
   */
  sensor: string;
  /**
   * The sensor that stands in for it; null: the run holds.
   */
  instead: string | null;
  /**
   * Ten minutes after the loss. Unit: that of `unit`.
   */
  after_10_min: number[];
  /**
   * An hour after it. Unit: that of `unit`.
   */
  after_1_h: number[];
  /**
   * On the rest of the day. Unit: that of `unit`.
   */
  rest_of_day: number[];
}
/**
 * Tip and tool axis over the day, in poses over the whole travel, standing still.
 */
export interface ExpectedPoses {
  /**
   * Poses: the corners of the travel, and others that fill it evenly.
   */
  poses: number;
  /**
   * Rows of the log that are shown.
   */
  rows: number;
  /**
   * Tip: the largest distance from where it should be, without the correction and with it.
   *
   * @minItems 2
   * @maxItems 2
   */
  tip_um: [number, number];
  /**
   * Of it: the temperatures have changed since the last sample.
   */
  tip_by_age_um: number;
  /**
   * Expanded uncertainty (k = 2) of the tip at the pose that is worst without the correction, by the machine file; null where it states none.
   */
  tip_expanded_uncertainty_um: number | null;
  /**
   * Tool axis: the largest angle, without the correction and with it; null without rotary axes.
   *
   * @minItems 2
   * @maxItems 2
   */
  tool_axis_urad: [number, number] | null;
  /**
   * Each live axis: what the plan must allow.
   */
  axes: ExpectedOffset[];
}
/**
 * The offset of one live axis.
 */
export interface ExpectedOffset {
  /**
   * Its letter.
   */
  axis: string;
  /**
   * um or urad.
   */
  unit: string;
  /**
   * The largest offset of the axis that is needed. Unit: that of `unit`.
   */
  needed: number;
  /**
   * The limit of the plan. Unit: that of `unit`.
   */
  limit: number;
}
/**
 * The records of parts.
 */
export interface LivePart {
  /**
   * Which document this is.
   */
  schema: "trueaxis/live-part/1";
  /**
   * The name of the plan.
   */
  name: string;
  /**
   * All parts with a record, by their names.
   */
  parts: string[];
  /**
   * The one that is made now; null if there is none.
   */
  recording: string | null;
  /**
   * The one that was asked for; null if none was.
   */
  part: LivePartEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * What acted while one part was made.
 */
export interface LivePartEntry {
  /**
   * Its name.
   */
  part: string;
  /**
   * The file of its record.
   */
  file: string;
  /**
   * Its rows: ends of blocks, and places where X and Y stood.
   */
  rows: number;
  /**
   * When its first row was made, seconds since 1970 (UTC); null without rows.
   */
  begun_s: number | null;
  /**
   * When its last row was made, seconds since 1970 (UTC).
   */
  ended_s: number | null;
  /**
   * The rows at which the correction had not followed throughout the block, the first 50.
   */
  not_followed: LivePartRow[];
  /**
   * How many these are.
   */
  not_followed_count: number;
  /**
   * How often another run went on with it: what was made in between is not in it.
   */
  interruptions: number;
  /**
   * Blocks of which nothing was known: they have no row.
   */
  unknown_blocks: number;
  /**
   * The live axes.
   */
  axes: LivePartAxis[];
  /**
   * The sensors.
   */
  sensors: LivePartSensor[];
}
/**
 * One row.
 */
export interface LivePartRow {
  /**
   * The number of the program; 0 where the control does not say. Unit: 1.
   */
  program: number;
  /**
   * The sequence number or line. Unit: 1.
   */
  block: number;
  /**
   * The clock of the run, s from its start.
   */
  time_s: number;
}
/**
 * One live axis over the rows.
 */
export interface LivePartAxis {
  /**
   * Its letter.
   */
  axis: string;
  /**
   * The unit of its numbers: um or urad.
   */
  unit: string;
  /**
   * The smallest and the largest that acted. Unit: that of `unit`.
   *
   * @minItems 2
   * @maxItems 2
   */
  acted: [number, number];
  /**
   * The largest that was missing or too much at the end of a block, by the model. Unit: that of `unit`.
   */
  left: number;
  /**
   * The same anywhere in a block, rapids included. Unit: that of `unit`.
   */
  left_largest: number;
}
/**
 * One sensor over the rows.
 */
export interface LivePartSensor {
  /**
   * The sensor of the machine file.
   */
  sensor: string;
  /**
   * The lowest and the highest.
   *
   * @minItems 2
   * @maxItems 2
   */
  celsius: [number, number];
}
/**
 * The state of a live run, or what the last run has left.
 */
export interface LiveStatus {
  /**
   * Which document this is.
   */
  schema: "trueaxis/live-status/1";
  /**
   * The name of the plan.
   */
  name: string;
  /**
   * Whether a run is going on now.
   */
  running: boolean;
  /**
   * The last state that is known; null if the plan never ran here.
   */
  last: LiveState | null;
  /**
   * The last changes of state, the oldest first.
   */
  events: LiveEventEntry[];
  /**
   * The last hours; null if they were not asked for.
   */
  history: LiveHistory | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The state after one cycle.
 */
export interface LiveState {
  /**
   * The state.
   */
  state: State;
  /**
   * Why it is in that state, in words.
   */
  reason: string;
  /**
   * The same for programs.
   */
  cause: Reason;
  /**
   * The clock of the run, s from its start.
   */
  time_s: number;
  /**
   * When it was written, seconds since 1970 (UTC).
   */
  date_s: number;
  /**
   * Which error is compensated: comprehensive, or that of the machine alone.
   */
  of: string;
  /**
   * The plan and machine file that the run began with; an edited file has no effect on it.
   */
  plan_hash: string;
  /**
   * The control, as it says it: kind, series and version.
   */
  control: string[];
  /**
   * The live axes.
   */
  axes: LiveAxisEntry[];
  /**
   * The sensors.
   */
  sensors: LiveSensorEntry[];
  /**
   * The feed along the path; null without a link.
   */
  feed_mm_per_min: number | null;
  /**
   * An axis has used four fifths of its limit.
   */
  near_limit: boolean;
  /**
   * An offset is late by more than the `lag` of its axis: the feed is too fast for the period.
   */
  lagging: boolean;
  /**
   * An axis stands outside its travel: its error is that of the end.
   */
  outside_travel: boolean;
  /**
   * The part whose record is filled; null without one.
   */
  part: string | null;
  /**
   * The number of the setup that is in the machine; null where the control does not say.
   */
  setup: number | null;
  /**
   * Cycles so far.
   */
  cycles: number;
  /**
   * Periods in which no cycle began.
   */
  missed: number;
  /**
   * Writes of offsets so far.
   */
  writes: number;
  /**
   * Writes that failed.
   */
  failed_writes: number;
}
/**
 * One live axis.
 */
export interface LiveAxisEntry {
  /**
   * Its letter.
   */
  axis: string;
  /**
   * The unit of its numbers: um or urad.
   */
  unit: string;
  /**
   * The position of the program, mm or deg; null without a link. Unit: mm or deg.
   */
  position: number | null;
  /**
   * The offset that the control holds, in the unit. Unit: that of `unit`.
   */
  offset: number | null;
  /**
   * The offset that acts, where the control reports it. Unit: that of `unit`.
   */
  acting: number | null;
  /**
   * The part of the offset that this program has written. Unit: that of `unit`.
   */
  own: number;
  /**
   * Where it goes. Unit: that of `unit`.
   */
  target: number | null;
  /**
   * Its limit. Unit: that of `unit`.
   */
  limit: number;
  /**
   * How far the offset is late, because the target moves and the position is two periods old; null without two targets.
   * Unit: that of `unit`.
   */
  lag: number | null;
  /**
   * What was missing when the zero of the part was touched, and is subtracted; of tip and tool axis together X, Y and Z of the
   * tip in the workpiece. Null without such a zero. Unit: that of `unit`.
   */
  datum: number | null;
}
/**
 * One sensor.
 */
export interface LiveSensorEntry {
  /**
   * Its name.
   */
  sensor: string;
  /**
   * The sensor of the machine file that it is.
   */
  input: string;
  /**
   * Its temperature; null if it cannot be used.
   */
  celsius: number | null;
  /**
   * The age of its last good sample.
   */
  age_s: number | null;
  /**
   * Why it cannot be used.
   */
  fault: string | null;
  /**
   * The sensor that stands in for it.
   */
  instead: string | null;
}
/**
 * A change of state.
 */
export interface LiveEventEntry {
  /**
   * When, seconds since 1970 (UTC).
   */
  date_s: number;
  /**
   * The clock of its run, s from its start.
   */
  time_s: number;
  /**
   * The state.
   */
  state: string;
  /**
   * Why.
   */
  reason: string;
}
/**
 * The last hours of a plan, up to now. Each line has the largest deviation of its ten seconds, each point that of its lines, so that
 * no peak is lost.
 */
export interface LiveHistory {
  /**
   * The time that it covers at most. Unit: h.
   */
  hours: number;
  /**
   * When, seconds since 1970 (UTC).
   */
  date_s: number[];
  /**
   * The state.
   */
  state: string[];
  /**
   * The live axes.
   */
  axes: LiveHistoryAxis[];
  /**
   * The sensors.
   */
  sensors: LiveHistorySensor[];
}
/**
 * One axis over time: what the tool is off along it by the model.
 */
export interface LiveHistoryAxis {
  /**
   * Its letter.
   */
  axis: string;
  /**
   * The unit of its numbers: um or urad.
   */
  unit: string;
  /**
   * Without the correction; null where nothing is known. Unit: that of `unit`.
   */
  before: (number | null)[];
  /**
   * With the offset that acted. Unit: that of `unit`.
   */
  left: (number | null)[];
  /**
   * The largest without the correction, of all lines, thinned or not; null where nothing is known. Unit: that of `unit`.
   */
  before_max: number | null;
  /**
   * The largest with it; null as above. Unit: that of `unit`.
   */
  left_max: number | null;
  /**
   * The root mean square over all cycles without the correction; null as above. Unit: that of `unit`.
   */
  before_rms: number | null;
  /**
   * The root mean square with it; null as above. Unit: that of `unit`.
   */
  left_rms: number | null;
}
/**
 * One sensor over time.
 */
export interface LiveHistorySensor {
  /**
   * Its name.
   */
  sensor: string;
  /**
   * Its temperature; null where it could not be used.
   */
  celsius: (number | null)[];
}
/**
 * A test piece that was cut and measured virtually.
 */
export interface MeasurePart {
  /**
   * Which document this is.
   */
  schema: "trueaxis/measure-part/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The random seed.
   */
  seed: number;
  /**
   * Whether the errors of the machine were drawn within their uncertainties.
   */
  drawn: boolean;
  /**
   * Standard uncertainty of a point along the normal, mm.
   */
  point_u_mm: number;
  /**
   * The true indices of the part, in the order of the test piece.
   */
  indices: TrueIndexEntry[];
  /**
   * The points.
   */
  points: MeasurePartPointEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A true index of a virtual part.
 */
export interface TrueIndexEntry {
  /**
   * Its key.
   */
  index: string;
  /**
   * Its value without the noise of the points, mm.
   */
  value_mm: number;
}
/**
 * A point of a virtual part.
 */
export interface MeasurePartPointEntry {
  /**
   * The number of its section, from 1 at the base.
   */
  section: number;
  /**
   * The point in the frame of the datum, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  place_mm: [number, number, number];
}
/**
 * The readings of a virtual machine.
 */
export interface Measure {
  /**
   * Which document this is.
   */
  schema: "trueaxis/measure/1";
  /**
   * Name of the campaign.
   */
  name: string;
  /**
   * Name of the machine.
   */
  machine: string;
  /**
   * Seed of the random numbers.
   */
  seed: number;
  /**
   * Duration of the measurement, s.
   */
  time_s: number;
  /**
   * Number of readings.
   */
  readings: number;
  /**
   * Number of readings that were lost.
   */
  lost: number;
  /**
   * The instruments of the campaign.
   */
  instruments: InstrumentEntry[];
  /**
   * Every channel of every instrument on every path.
   */
  channels: MeasureChannelEntry[];
  /**
   * The files that were written.
   */
  files: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * An instrument.
 */
export interface InstrumentEntry {
  /**
   * Its name in the campaign.
   */
  name: string;
  /**
   * What kind of instrument it is.
   */
  kind: string;
  /**
   * Number of its readings.
   */
  readings: number;
}
/**
 * Reading less nominal reading of one channel on one path.
 */
export interface MeasureChannelEntry {
  /**
   * The path.
   */
  path: string;
  /**
   * The instrument.
   */
  instrument: string;
  /**
   * The channel.
   */
  channel: string;
  /**
   * Number of readings.
   */
  count: number;
  /**
   * Row of the largest deviation, from 0.
   */
  largest_row: number;
  [k: string]: number;
}
/**
 * A new folder.
 */
export interface New {
  /**
   * Which document this is.
   */
  schema: "trueaxis/new/1";
  /**
   * The folder.
   */
  folder: string;
  /**
   * The kind of machine.
   */
  kind: string;
  /**
   * The names of its files.
   */
  files: string[];
  /**
   * The commands to try there, in their order.
   *
   * @minItems 4
   * @maxItems 4
   */
  commands: [string, string, string, string];
}
/**
 * A part file or a draft of one: `trueaxis/part/1`.
 */
export interface Part {
  /**
   * Which document this is.
   */
  schema: "trueaxis/part/1";
  /**
   * The name of the part; null for a draft.
   */
  name: string | null;
  /**
   * The features of a part file.
   */
  features: PartFeatureEntry[];
  /**
   * Its characteristics.
   */
  characteristics: PartCharacteristicEntry[];
  /**
   * The draft of a QIF file; null for a part file.
   */
  draft: DraftEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A feature of a part file.
 */
export interface PartFeatureEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * `plane`, `cylinder`, `cone`, `sphere`, `torus`, `slot`, `tongue`, `thread`, `points` or `programmed surface`.
   */
  shape: string;
  /**
   * Its letter as a datum.
   */
  datum: string | null;
  /**
   * How many points are checked; of a surface of the program, lines of sight.
   */
  points: number;
}
/**
 * A characteristic of a part file.
 */
export interface PartCharacteristicEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * What is asked, such as `flatness`.
   */
  kind: string;
  /**
   * Of which feature or pattern.
   */
  feature: string;
  /**
   * To which features, the first datum first.
   */
  datums: string[];
  /**
   * How far its zone reaches beyond the end of the axis, below 0 beyond its beginning; absent without a projected zone, mm.
   */
  projected_mm?: number | null;
  /**
   * The least value allowed; null for a zone, mm.
   */
  low_mm: number | null;
  /**
   * The largest value allowed, mm.
   */
  high_mm: number;
}
/**
 * A draft of a part file.
 */
export interface DraftEntry {
  /**
   * The text of the part file.
   */
  text: string;
  /**
   * How many features it has.
   */
  features: number;
  /**
   * How many characteristics.
   */
  characteristics: number;
  /**
   * How many values the file does not state; they are written as `"?"`.
   */
  unknown: number;
  /**
   * What of the QIF file is not in it.
   */
  left_out: PartLeftOutEntry[];
}
/**
 * Something that is not in a draft.
 */
export interface PartLeftOutEntry {
  /**
   * Its id in the QIF file.
   */
  id: string;
  /**
   * What it is.
   */
  what: string;
  /**
   * Why it is not in the draft.
   */
  reason: string;
  /**
   * Its line in the QIF file.
   */
  line: number;
}
/**
 * A probing path over a surface.
 */
export interface PlanProbeSurface {
  /**
   * Which document this is.
   */
  schema: "trueaxis/plan-probe-surface/1";
  /**
   * Name of the study.
   */
  name: string;
  /**
   * Number of points that were spread over the surface.
   */
  asked: number;
  /**
   * The points that the probe touches, in their order.
   */
  points: PlanProbeSurfacePointEntry[];
  /**
   * Least distance of two points, mm.
   */
  spacing_mm: number;
  /**
   * How long the program runs, s.
   */
  duration_s: number;
  /**
   * Whether the program has neither errors nor critical issues.
   */
  sound: boolean;
  /**
   * Errors of the program itself.
   */
  errors: string[];
  /**
   * Critical issues, such as collisions.
   */
  troubles: string[];
  /**
   * Minor issues, such as lost time.
   */
  notes: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A point that the probe touches.
 */
export interface PlanProbeSurfacePointEntry {
  /**
   * Where it is, workpiece frame, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  point_mm: [number, number, number];
  /**
   * The normal of the surface there, out of the material. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  normal: [number, number, number];
  /**
   * Its line in the file of the surface.
   */
  line: number;
}
/**
 * Touches at a tool setter.
 */
export interface PlanToolSetting {
  /**
   * Which document this is.
   */
  schema: "trueaxis/plan-tool-setting/1";
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The touches in their order.
   */
  touches: TouchEntry[];
  /**
   * How long the program runs, s.
   */
  duration_s: number;
  /**
   * Whether the program has neither errors nor critical issues.
   */
  sound: boolean;
  /**
   * Errors of the program itself.
   */
  errors: string[];
  /**
   * Critical issues, such as collisions.
   */
  troubles: string[];
  /**
   * Minor issues, such as lost time.
   */
  notes: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * One touch.
 */
export interface TouchEntry {
  /**
   * The tool.
   */
  tool: number;
  /**
   * What it measures: `length`, `plus` or `minus` (the sides of the diameter).
   */
  of: string;
  /**
   * X, Y and Z where the nominal tool touches, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  expected_mm: [number, number, number];
  /**
   * X, Y and Z where the touch ends at the latest, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  beyond_mm: [number, number, number];
}
/**
 * What a campaign will show before anybody measures.
 */
export interface Plan {
  /**
   * Which document this is.
   */
  schema: "trueaxis/plan/1";
  /**
   * Name of the campaign.
   */
  name: string;
  /**
   * Name of the machine.
   */
  machine: string;
  /**
   * The kinematic chain of the machine.
   */
  chain: string;
  /**
   * The paths and their programs.
   */
  paths: PlanPathEntry[];
  /**
   * What each stage will determine; empty if the campaign has none.
   */
  stages: PlannedStageEntry[];
  /**
   * The uncertainty to expect of each unknown.
   */
  expected: ExpectedEntry[];
  /**
   * Combinations of unknowns that change no reading.
   */
  unobservable: Unobservable[];
  /**
   * Number of combinations of unknowns that are observable.
   */
  rank: number;
  /**
   * Condition number of the design matrix. Unit: 1.
   */
  condition: number;
  /**
   * The choice of poses; null if none was asked for.
   */
  chosen: ChosenEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A path and its program.
 */
export interface PlanPathEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Number of stations.
   */
  stations: number;
  /**
   * Feed if it is read while moving, mm/min; else null.
   */
  feed_mm_per_min: number | null;
  /**
   * Dwell at each station, s.
   */
  dwell_s: number;
  /**
   * Channels of the instrument.
   */
  channels: string[];
  /**
   * Unit of the readings below: `um` or `urad`.
   */
  unit: string;
  /**
   * The largest reading that 10 µm or 10 µrad of each error causes.
   */
  seen_of_10_um_or_urad: SeenEntry[];
  /**
   * The check of its program, or why there is none.
   */
  program: PlanProgramEntry;
}
/**
 * The readings that an error causes.
 */
export interface SeenEntry {
  /**
   * The error.
   */
  error: string;
  /**
   * The largest reading of each channel. Unit: that of the path.
   */
  largest: number[];
}
/**
 * A stage of a plan for programs.
 */
export interface PlannedStageEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * The uncertainty of each unknown after it.
   */
  expected: PlannedValue[];
}
/**
 * What is expected of an unknown after a stage.
 */
export interface PlannedValue {
  /**
   * Its name.
   */
  name: string;
  /**
   * `um`, `urad`, `ms` or `um/m`.
   */
  unit: string;
  /**
   * Expanded uncertainty (k = 2); null if it is not known then. Unit: that of `unit`.
   */
  expanded_k2: number | null;
}
/**
 * The uncertainty to expect of an unknown.
 */
export interface ExpectedEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * `um`, `urad`, or `um/m` for a scale.
   */
  unit: string;
  /**
   * Standard uncertainty; null if not observable. Unit: that of `unit`.
   */
  u: number | null;
  /**
   * Expanded uncertainty (k = 2); null if not observable. Unit: that of `unit`.
   */
  expanded_k2: number | null;
}
/**
 * The chosen poses.
 */
export interface ChosenEntry {
  /**
   * Number of poses.
   */
  poses: number;
  /**
   * Number of poses to choose from.
   */
  candidates: number;
  /**
   * Candidates left out because of collisions or travel limits.
   */
  blocked: number;
  /**
   * Number of readings.
   */
  readings: number;
  /**
   * Duration of the measurement, s.
   */
  time_s: number;
  /**
   * The criterion at the start and after every exchange. Unit: 1.
   */
  criterion: number[];
  /**
   * The uncertainties to expect.
   */
  expected: ExpectedEntry[];
  /**
   * A plain grid of as many poses, to compare with; null if there is none.
   */
  grid: ServePlanGridEntry | null;
}
/**
 * A plain grid of poses.
 */
export interface ServePlanGridEntry {
  /**
   * Number of poses.
   */
  poses: number;
  /**
   * The uncertainties to expect.
   */
  expected: ExpectedEntry[];
}
/**
 * The tool at many positions of the axes.
 */
export interface PoseRows {
  /**
   * Which document this is.
   */
  schema: "trueaxis/pose/1";
  /**
   * One object for each row of the input: its columns as they were given, then `tip_x_mm` … `axis_k` (the
   * nominal tool in the workpiece frame), `dev_x_um` … `dev_k_urad` (actual − nominal).
   */
  rows: {
    [k: string]: number;
  }[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The tool at one position of the axes.
 */
export interface Pose {
  /**
   * Which document this is.
   */
  schema: "trueaxis/pose/1";
  /**
   * As the control commands it.
   */
  nominal: ToolPoseEntry;
  /**
   * As the machine with its errors moves it.
   */
  actual: ToolPoseEntry;
  /**
   * Actual − nominal.
   */
  deviation: PoseDeviationEntry;
  /**
   * The deviation under each error alone.
   */
  budget: ShareEntry[];
  /**
   * Nominal and actual place of every body; absent unless it was asked for.
   */
  bodies?: BodyEntry[] | null;
  /**
   * By the name of the cause: `geometric`, `scale`, `structure`, `workpiece`.
   */
  split?: {
    [k: string]: TipEntry;
  };
  /**
   * Of the machine without the growth of the workpiece.
   */
  machine?: TipEntry;
  /**
   * Of all together.
   */
  comprehensive?: ComprehensiveEntry;
  /**
   * How fast the workpiece takes the temperature of the air; absent where that is not stated.
   */
  settling?: SettlingEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A tool in the workpiece frame.
 */
export interface ToolPoseEntry {
  /**
   * Its tip, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_mm: [number, number, number];
  /**
   * Its axis from the tip to the spindle, a unit vector. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  axis: [number, number, number];
}
/**
 * A deviation of the tool.
 */
export interface PoseDeviationEntry {
  /**
   * Of the tip, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_um: [number, number, number];
  /**
   * Of the axis, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  axis_urad: [number, number, number];
}
/**
 * One error alone.
 */
export interface ShareEntry {
  /**
   * The ISO 230-1 name of the error; `EXX(scale)`, `workpiece` and the like for the parts of temperatures.
   */
  error: string;
  /**
   * Of the tip, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_um: [number, number, number];
  /**
   * Of the axis, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  axis_urad: [number, number, number];
}
/**
 * A body of the machine.
 */
export interface BodyEntry {
  /**
   * Its name.
   */
  body: string;
  /**
   * Its nominal place in the machine frame.
   */
  nominal: PlaceEntry;
  /**
   * Its actual place there.
   */
  actual: PlaceEntry;
}
/**
 * The place of a body.
 */
export interface PlaceEntry {
  /**
   * Its origin, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  origin_mm: [number, number, number];
  /**
   * Its rotation, row by row. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  rotation: [[number, number, number], [number, number, number], [number, number, number]];
}
/**
 * A deviation of the tip.
 */
export interface TipEntry {
  /**
   * Deviation of the tip, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_um: [number, number, number];
}
/**
 * The deviation of the tip from all causes.
 */
export interface ComprehensiveEntry {
  /**
   * Deviation of the tip, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_um: [number, number, number];
  /**
   * How it is made up.
   */
  formula: string;
}
/**
 * How fast the workpiece takes the temperature of the air.
 */
export interface SettlingEntry {
  /**
   * Its time constant, s.
   */
  time_constant_s: number;
  /**
   * The time until a tenth of a difference remains, s.
   */
  time_to_a_tenth_s: number;
}
/**
 * An NC program from cutter locations.
 */
export interface Post {
  /**
   * Which document this is.
   */
  schema: "trueaxis/post/1";
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The file of the cutter locations.
   */
  file: string;
  /**
   * The file of the program.
   */
  program: string;
  /**
   * Whether the program was written: not where the verification found it out of tolerance.
   */
  written: boolean;
  /**
   * Points of the cutter-location file.
   */
  points: number;
  /**
   * Strokes of the tool in the file.
   */
  strokes: number;
  /**
   * Blocks that move the tool along them.
   */
  blocks: number;
  /**
   * Lines of the program.
   */
  lines: number;
  /**
   * Blocks that are arcs.
   */
  arcs: number;
  /**
   * Holes that the control drills by its own cycle.
   */
  holes: number;
  /**
   * How many of them are tapped threads.
   */
  threads: number;
  /**
   * How often the tool retracts so that an axis can rewind.
   */
  rewinds: number;
  /**
   * How far the tool axis was turned to pass through a pole, degrees.
   */
  pole_deviation_deg: number;
  /**
   * The tolerance of the tip, mm.
   */
  tolerance_mm: number;
  /**
   * The tolerance of the tool axis, degrees.
   */
  axis_tolerance_deg: number;
  /**
   * Words of the file that can change motion, spindle or coolant and are not applied; the exit status is then 1.
   */
  not_applied: number;
  /**
   * The program read back and simulated; null if that was not asked for.
   */
  verify: VerificationEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A program read back and simulated on the nominal machine.
 */
export interface VerificationEntry {
  /**
   * Whether it is within the tolerances and every axis within its travel.
   */
  within_tolerance: boolean;
  /**
   * How many blocks were compared at their ends.
   */
  blocks_compared: number;
  /**
   * Largest deviation of the tip at the ends of blocks, µm.
   */
  tip_at_blocks_um: LargestEntry;
  /**
   * Largest deviation of the tool axis at the ends of blocks, µrad.
   */
  axis_at_blocks_urad: LargestEntry;
  /**
   * Largest distance of the tip from the path, µm.
   */
  tip_on_path_um: LargestEntry;
  /**
   * Largest angle of the tool axis from the path, degrees.
   */
  axis_on_path_deg: LargestEntry;
  /**
   * Largest error of the lead of tapped threads over their depth, µm; 0 without threads, null where one is not tapped.
   */
  lead_um: LargestEntry;
  /**
   * Whether an axis leaves its travel.
   */
  axes_beyond_travel: boolean;
}
/**
 * The largest deviation and where it is.
 */
export interface LargestEntry {
  /**
   * The value. Unit: that of the key.
   */
  value: number;
  /**
   * The line of the program.
   */
  program_line: number;
  /**
   * The line of the cutter-location file.
   */
  file_line: number;
}
/**
 * Holes before they are made, under each compensation: `trueaxis/predict/1`.
 */
export interface PredictHoles {
  /**
   * Which document this is.
   */
  schema: "trueaxis/predict/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The least increment of the control, mm.
   */
  increment_mm: number;
  /**
   * The tolerance of the place of a hole; null if none is stated, mm.
   */
  tolerance_mm: number | null;
  /**
   * The tolerance of the location diameter, either way; null if none is stated, mm.
   */
  location_tolerance_mm: number | null;
  /**
   * The compensation that is applied: `none`, `machine`, `comprehensive`, or `acted`: what a live run has recorded.
   */
  applied: string;
  /**
   * Whether all stated tolerances are kept with it; null if none is stated.
   */
  in_tolerance: boolean | null;
  /**
   * The log that the temperatures follow; null if there is none.
   */
  temperature_log: string | null;
  /**
   * The record of what acted; null without one.
   */
  acted_record: string | null;
  /**
   * The holes under each compensation.
   */
  sets: SetEntry[];
  /**
   * The same at the temperatures of the start, held; null where no log runs.
   */
  sets_at_start: SetEntry[] | null;
  /**
   * What grows with the temperature though the uncertainty of its coefficient is not stated: u lacks it.
   */
  u_lacks: string[];
  /**
   * What to know of this prediction.
   */
  warnings: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The holes under one compensation.
 */
export interface SetEntry {
  /**
   * `none`, `machine`, `comprehensive` or `acted`.
   */
  compensation: string;
  /**
   * The largest distance of a hole from its place in X and Y, mm.
   */
  worst_mm: number;
  /**
   * Its standard uncertainty, mm.
   */
  u_worst_mm: number;
  /**
   * Whether all places are in tolerance; null if none is stated.
   */
  in_tolerance: boolean | null;
  /**
   * Whether the location diameter is in its tolerance; null if none is stated.
   */
  location_in_tolerance: boolean | null;
  /**
   * The circle on which the holes are; null for fewer than three.
   */
  location_diameter: LocationEntry | null;
  /**
   * The holes in the order of the study.
   */
  holes: HoleEntry[];
}
/**
 * The circle of the holes at 20 °C, less the nominal one.
 */
export interface LocationEntry {
  /**
   * Its diameter by least squares, µm.
   */
  error_um: number;
  /**
   * Standard uncertainty of that, µm.
   */
  u_um: number;
  /**
   * Smallest and largest distance of opposite holes; null where the number of holes is odd, µm.
   *
   * @minItems 2
   * @maxItems 2
   */
  opposite_um: [number, number] | null;
  /**
   * Standard uncertainties of these two, µm.
   *
   * @minItems 2
   * @maxItems 2
   */
  u_opposite_um: [number, number] | null;
  /**
   * Where its centre is along X and Y, µm.
   *
   * @minItems 2
   * @maxItems 2
   */
  centre_um: [number, number];
}
/**
 * One hole.
 */
export interface HoleEntry {
  /**
   * Where it should be in the workpiece frame, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  nominal_mm: [number, number, number];
  /**
   * Where it is at 20 °C, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  actual_mm: [number, number, number];
  /**
   * The difference, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  error_um: [number, number, number];
  /**
   * Its standard uncertainty, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  u_um: [number, number, number];
  /**
   * What the control adds, in least increments along X, Y, Z.
   *
   * @minItems 3
   * @maxItems 3
   */
  compensation_increments: [number, number, number];
  /**
   * When it is made, from the start, s.
   */
  time_s: number;
}
/**
 * A part before it is cut, judged by its drawing: `trueaxis/predict/1`.
 */
export interface PredictPart {
  /**
   * Which document this is.
   */
  schema: "trueaxis/predict/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The name of the part.
   */
  part: string;
  /**
   * `pass`, `fail`, or `undecided` within the uncertainty.
   */
  outcome: string;
  /**
   * The same by the compensated program, the zero where it was set; absent unless it was asked for.
   */
  compensated_outcome?: string | null;
  /**
   * The same with the zero set again by compensated motion.
   */
  compensated_zero_set_outcome?: string | null;
  /**
   * Errors each of whose corrections alone brings all characteristics into tolerance, the best first; empty where they are.
   */
  sufficient: string[];
  /**
   * Steps of the tools.
   */
  steps: number;
  /**
   * Errors of the machine file without a stated uncertainty; they add nothing to `u_mm`.
   */
  errors_without_u: string[];
  /**
   * The Monte Carlo run; absent if there was none.
   */
  monte_carlo?: ManyEntry | null;
  /**
   * The lines of the drawing, in the order of the part file.
   */
  characteristics: CharacteristicEntry[];
  /**
   * The features, in the order of the part file.
   */
  features: FeatureEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * A Monte Carlo run for a part.
 */
export interface ManyEntry {
  /**
   * How many machines were drawn.
   */
  samples: number;
  /**
   * The random seed.
   */
  seed: number;
  /**
   * The share of them on which all characteristics are in tolerance. Unit: 1.
   */
  good_ratio: number;
}
/**
 * One line of the drawing.
 */
export interface CharacteristicEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * What is asked, such as `flatness`.
   */
  kind: string;
  /**
   * Of which feature or pattern.
   */
  feature: string;
  /**
   * The features that are meant: one, or all of the pattern.
   */
  features: string[];
  /**
   * To which features, the first datum first; empty: to the zero that was set.
   */
  datums: string[];
  /**
   * How far its zone reaches beyond the end of the axis, below 0 beyond its beginning; absent without a projected zone, mm.
   */
  projected_mm?: number | null;
  /**
   * Its value; of a size the deviation from the nominal one, mm.
   */
  value_mm: number;
  /**
   * Standard uncertainty of that, by the stated uncertainties of the machine, mm.
   */
  u_mm: number;
  /**
   * By how much the value changes with half of the points, mm.
   */
  points_mm: number;
  /**
   * As the measuring machine of the study would find it; absent if the study states none.
   */
  measured?: ServeWhatIfMeasuredEntry | null;
  /**
   * The value that the program leaves on a machine without errors, mm.
   */
  nominal_mm: number;
  /**
   * The least value allowed; null for a zone, mm.
   */
  low_mm: number | null;
  /**
   * The largest value allowed, mm.
   */
  high_mm: number;
  /**
   * How much of the tolerance is used, 1 at a limit. Unit: 1.
   */
  used_ratio: number;
  /**
   * `pass`, `fail` or `undecided`.
   */
  outcome: string;
  /**
   * By the compensated program, the zero where it was set; absent unless it was asked for.
   */
  compensated?: CompensatedEntry | null;
  /**
   * The same with the zero set again by compensated motion.
   */
  compensated_zero_set?: CompensatedEntry | null;
  /**
   * From the Monte Carlo run; absent if there was none.
   */
  monte_carlo?: DrawnEntry | null;
  /**
   * The errors that matter most, the largest first.
   */
  errors: ErrorEffectEntry[];
}
/**
 * A characteristic as it would be measured.
 */
export interface ServeWhatIfMeasuredEntry {
  /**
   * The mean of its values, mm.
   */
  mean_mm: number;
  /**
   * Standard uncertainty by the scatter of the points, mm.
   */
  u_mm: number;
}
/**
 * A characteristic by the compensated program.
 */
export interface CompensatedEntry {
  /**
   * Its value, mm.
   */
  value_mm: number;
  /**
   * `pass`, `fail` or `undecided`, with the u of before.
   */
  outcome: string;
}
/**
 * A characteristic in the Monte Carlo run.
 */
export interface DrawnEntry {
  /**
   * The mean, mm.
   */
  mean_mm: number;
  /**
   * The standard uncertainty, mm.
   */
  u_mm: number;
  /**
   * Lower and upper end of the 95 % interval, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  interval_95_mm: [number, number];
  /**
   * The share of machines on which it is in tolerance. Unit: 1.
   */
  good_ratio: number;
}
/**
 * What an error does to a characteristic.
 */
export interface ErrorEffectEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  /**
   * The value without it, mm.
   */
  without_mm: number;
}
/**
 * A feature as it was cut.
 */
export interface FeatureEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * `plane`, `cylinder`, `cone`, `sphere`, `torus`, `slot`, `tongue`, `thread`, `points` or `programmed surface`.
   */
  shape: string;
  /**
   * How many points it has.
   */
  points: number;
  /**
   * How far neighbouring points are apart, mm.
   */
  spacing_mm: number;
  /**
   * The point with the most material left.
   */
  most: ServeWhatIfPointEntry;
  /**
   * The point with the most material missing, or the least left.
   */
  least: ServeWhatIfPointEntry;
  /**
   * Mean of the deviations, mm.
   */
  mean_mm: number;
}
/**
 * A point of a feature.
 */
export interface ServeWhatIfPointEntry {
  /**
   * Where it should be in the workpiece frame, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  nominal_mm: [number, number, number];
  /**
   * The deviation along the normal; positive where material is left, mm.
   */
  deviation_mm: number;
  /**
   * What the program leaves there on a machine without errors, mm.
   */
  by_program_mm: number;
  /**
   * The tool that cut it.
   */
  tool: number;
  /**
   * The file of the program, or of a subprogram.
   */
  program: string;
  /**
   * Its line.
   */
  line: number;
  /**
   * When, from the start of the program, s.
   */
  time_s: number;
  /**
   * The errors that displace it most, the largest first.
   */
  errors: PointEffectEntry[];
}
/**
 * What an error does to a point.
 */
export interface PointEffectEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  /**
   * How much of the deviation of the point it makes, mm.
   */
  part_mm: number;
}
/**
 * A test piece before it is cut: `trueaxis/predict/1`.
 */
export interface Predict {
  /**
   * Which document this is.
   */
  schema: "trueaxis/predict/1";
  /**
   * The version of TrueAxis.
   */
  version: string;
  /**
   * The name of the study.
   */
  study: string;
  /**
   * The machine.
   */
  machine: PredictMachineEntry;
  /**
   * The name of the test piece.
   */
  test_piece: string;
  /**
   * `pass`, `fail` or `undecided`.
   */
  verdict: string;
  /**
   * The indices, those of ISO under `iso`, those of the paper under `paper`, mm.
   */
  indices: {
    [k: string]: Grouped;
  };
  /**
   * The tolerances with their verdicts.
   */
  judgements: JudgementEntry[];
  /**
   * Where the axes stand when the zero is set, mm and deg.
   */
  setting_command: {
    [k: string]: number;
  };
  /**
   * The form at each measuring position.
   */
  positions: PredictPositionEntry[];
  /**
   * The share of each error in each index, the largest first.
   */
  blame: PredictShareEntry[];
  /**
   * The same with all errors of a body together.
   */
  blame_by_body: PredictShareEntry[];
  /**
   * The same with all location errors and all error motions together.
   */
  blame_by_kind: PredictShareEntry[];
  /**
   * Slopes of the indices by each location error.
   */
  sensitivity: SensitivityEntry[];
  /**
   * Single corrections after which the part would pass, the smallest first.
   */
  corrections: CorrectionEntry[];
  /**
   * The same part with other setting points and datums.
   */
  variants: VariantEntry[];
  /**
   * Axis positions of all tool positions, mm and deg.
   */
  commands: {
    [k: string]: number;
  }[];
  /**
   * The Monte Carlo run; null if there was none.
   */
  monte_carlo: SamplingEntry | null;
  /**
   * The log that the temperatures follow; null if there is none.
   */
  temperature_log: string | null;
  /**
   * The part at the feed of every cutting condition; absent without `[servo]`.
   */
  conditions?: ConditionEntry[];
  /**
   * What to know of this prediction.
   */
  warnings: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The machine.
 */
export interface PredictMachineEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its chain from the workpiece to the tool.
   */
  chain: string;
}
/**
 * An index of the whole part.
 */
export interface IndexEntry {
  /**
   * Its value. Unit: mm.
   */
  value: number;
  /**
   * Its standard uncertainty by linear propagation, mm.
   */
  u_mm: number;
  /**
   * From the Monte Carlo run; absent if there was none.
   */
  monte_carlo?: ServeWhatIfSpreadEntry | null;
}
/**
 * What the Monte Carlo run gives for an index.
 */
export interface ServeWhatIfSpreadEntry {
  /**
   * The mean, mm.
   */
  mean_mm: number;
  /**
   * The standard uncertainty, mm.
   */
  u_mm: number;
  /**
   * Lower and upper end of the 95 % interval, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  interval_95_mm: [number, number];
}
/**
 * A tolerance with its verdict.
 */
export interface JudgementEntry {
  /**
   * The key of the index.
   */
  index: string;
  /**
   * Its value, mm.
   */
  value_mm: number;
  /**
   * The tolerance, mm.
   */
  tolerance_mm: number;
  /**
   * The expanded uncertainty; null where the rule uses none, mm.
   */
  expanded_mm: number | null;
  /**
   * Value divided by tolerance. Unit: 1.
   */
  used_ratio: number;
  /**
   * Whether the verdict depends on it.
   */
  decisive: boolean;
  /**
   * `pass`, `fail` or `undecided`.
   */
  verdict: string;
}
/**
 * The form at one measuring position.
 */
export interface PredictPositionEntry {
  /**
   * Its number, from 1.
   */
  position: number;
  /**
   * Its place along the axis of the part in the workpiece frame, mm.
   */
  z_mm: number;
  /**
   * Its height above the base, mm.
   */
  height_mm: number;
  /**
   * The nominal radius, mm.
   */
  nominal_radius_mm: number;
  /**
   * Where the form is given, deg.
   */
  azimuth_deg: number[];
  /**
   * The error there, positive where material is left, mm.
   */
  e_mm: number[];
  [k: string]: Grouped2;
}
/**
 * An index at one position.
 */
export interface PositionIndex {
  /**
   * Its value. Unit: mm.
   */
  value: number;
  /**
   * Its standard uncertainty, mm.
   */
  u_mm: number;
}
/**
 * The share of an error, or of a group of errors, in an index.
 */
export interface PredictShareEntry {
  /**
   * The ISO 230-1 name, or the name of the group.
   */
  error: string;
  /**
   * The key of the index.
   */
  index: string;
  /**
   * The index if there were only this error, mm.
   */
  alone_mm: number;
  /**
   * The index without this error, mm.
   */
  without_mm: number;
}
/**
 * Slopes of the indices by one location error.
 */
export interface SensitivityEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  [k: string]: {
    [k: string]: number;
  };
}
/**
 * A correction of one location error after which the part would pass.
 */
export interface CorrectionEntry {
  /**
   * Its ISO 230-1 name.
   */
  error: string;
  /**
   * The indices after it, mm.
   */
  indices_mm: {
    [k: string]: number;
  };
  [k: string]: number;
}
/**
 * The same part with another setting point or datum.
 */
export interface VariantEntry {
  /**
   * What is different.
   */
  name: string;
  /**
   * The indices, mm.
   */
  indices_mm: {
    [k: string]: number;
  };
}
/**
 * A Monte Carlo run.
 */
export interface SamplingEntry {
  /**
   * How many machines were drawn.
   */
  samples: number;
  /**
   * The random seed.
   */
  seed: number;
}
/**
 * The part at the feed of one cutting condition.
 */
export interface ConditionEntry {
  /**
   * Its name.
   */
  condition: string;
  /**
   * The feed of the tip, mm/min.
   */
  feed_mm_per_min: number;
  /**
   * The lowest and the highest speed of the tip that the axes allow, mm/min.
   *
   * @minItems 2
   * @maxItems 2
   */
  tip_mm_per_min: [number, number];
  /**
   * Index after index.
   */
  indices: ConditionIndexEntry[];
  /**
   * `pass`, `fail` or `undecided`.
   */
  verdict: string;
}
/**
 * An index at the feed of a cutting condition.
 */
export interface ConditionIndexEntry {
  /**
   * Its key.
   */
  index: string;
  /**
   * Its value, mm.
   */
  value_mm: number;
  /**
   * Its standard uncertainty, mm.
   */
  u_mm: number;
  /**
   * The part of it that comes from the servo alone, mm.
   */
  u_servo_mm: number;
  /**
   * The value less that without following errors, mm.
   */
  added_mm: number;
  /**
   * The value with the servo alone, on a machine without errors, mm.
   */
  servo_alone_mm: number;
}
/**
 * The answer of a command that cannot use its input; the exit status is 2.
 */
export interface Refused {
  /**
   * Which document this is.
   */
  schema: "trueaxis/refused/1";
  /**
   * The version of TrueAxis.
   */
  version: string;
  /**
   * What is wrong, at least one error, in the order of the files.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * An array of a binary answer.
 */
export interface ServeArray {
  /**
   * Its name.
   */
  name: string;
  /**
   * The type of its numbers, little endian.
   */
  type: "f64" | "f32" | "u32" | "u8";
  /**
   * How many numbers it has.
   */
  count: number;
}
/**
 * Moves a path onto the blank that was measured.
 */
export interface ServeCompensateAdaptRequest {
  /**
   * The study: path, measured blank, cutter, wall.
   */
  study: string;
  /**
   * The control of the program, as `--control` of the command line; without one only the path is made.
   */
  control?: string | null;
}
/**
 * A path that was adapted.
 */
export interface ServeCompensateAdapt {
  /**
   * The document of `trueaxis compensate adapt`.
   */
  document: AdaptDocument;
  /**
   * Its report.
   */
  shown: ShownEntry;
  /**
   * The adapted path and its program; none if it must not be cut.
   */
  made: MadeEntry;
  /**
   * The problems of the study.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A path moved onto a measured blank: `trueaxis/compensate-adapt/1`.
 */
export interface AdaptDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/compensate-adapt/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The file of the path.
   */
  path: string;
  /**
   * `good`, `not applied` (words of the path are not) or `not to be cut`.
   */
  verdict: string;
  /**
   * Words of the path that can change motion, spindle or coolant and are not applied; the exit status is then 1.
   */
  not_applied: number;
  /**
   * What speaks against the path.
   */
  findings: FindingEntry[];
  /**
   * How the blank lies.
   */
  registration: RegistrationEntry;
  /**
   * The form of the blank.
   */
  field: FieldEntry;
  /**
   * The places of the path.
   */
  places: PlacesEntry;
  /**
   * The wall that remains.
   */
  wall: WallEntry;
  /**
   * The wall place by place.
   */
  map: CellEntry[];
  /**
   * The program of the adapted path; null if none was asked for.
   */
  program: ProgramEntry | null;
}
/**
 * A report of the command line without its pictures.
 */
export interface ShownEntry {
  /**
   * Its title.
   */
  title: string;
  /**
   * The lines below it.
   */
  lines: string[];
  /**
   * The verdict; null if there is none.
   */
  verdict: Verdict | null;
  /**
   * Its sections in their order.
   */
  sections: ShownSection[];
}
/**
 * The result in one word and in one sentence.
 */
export interface Verdict {
  /**
   * How it is coloured.
   */
  standing: Standing;
  /**
   * `PASS`.
   */
  word: string;
  /**
   * What that means; may be empty.
   */
  sentence: string;
}
/**
 * A part of the report.
 */
export interface ShownSection {
  /**
   * Its title; may be empty.
   */
  title: string;
  /**
   * What stands in it.
   */
  items: ShownItem[];
}
/**
 * The files that an answer made.
 */
export interface MadeEntry {
  /**
   * Their number on the server, for `save-made` and the address `/made/NUMBER/FILE`; only the last few are kept.
   */
  number: number;
  /**
   * The files.
   */
  files: MadeFileEntry[];
}
/**
 * A file that can be downloaded or saved.
 */
export interface MadeFileEntry {
  /**
   * Where it would go, below the project folder.
   */
  name: string;
  /**
   * Its size in bytes.
   */
  bytes: number;
  /**
   * Its beginning; what is not UTF-8 is shown as replacement characters.
   */
  beginning: string;
  /**
   * Whether that is all of it.
   */
  whole: boolean;
}
/**
 * Rewrites an NC program for the actual machine.
 */
export interface ServeCompensateProgramRequest {
  /**
   * The machine file.
   */
  machine: string;
  /**
   * The NC program.
   */
  program: string;
  /**
   * The set-up file; the one beside the program if it is left out.
   */
  setup?: string | null;
  /**
   * The control that the program is for, as `--control` of the command line.
   */
  control?: string | null;
  /**
   * Temperatures as `--temperature` takes them, such as `scale_x=30.5 workpiece=31`.
   */
  temperature?: string | null;
  /**
   * As `--machine-only`; false if it is left out.
   */
  machine_only?: boolean | null;
  /**
   * As `--flat`; false if it is left out.
   */
  flat?: boolean | null;
  /**
   * As `--position-only`; false if it is left out.
   */
  position_only?: boolean | null;
  /**
   * As `--keep-unproved`; false if it is left out.
   */
  keep_unproved?: boolean | null;
  /**
   * As `--residual`; `1 um` if it is left out.
   */
  residual?: string | null;
  /**
   * As `--increment`; `1 um` if it is left out.
   */
  increment?: string | null;
}
/**
 * A program that was rewritten. Array: `along` (f64: for each block, or for each stretch of blocks of a long program,
 * its line, then the largest deviation of the tip before and after, µm, and of the tool axis before and after, µrad).
 */
export interface ServeCompensateProgram {
  /**
   * The document of `trueaxis compensate program`.
   */
  document: ProgramDocument;
  /**
   * Its report.
   */
  shown: ShownEntry;
  /**
   * The first changed lines; null if the program was unrolled, or not written.
   */
  changes: ChangesEntry | null;
  /**
   * The compensated program; without a file if it was not proved.
   */
  made: MadeEntry;
  /**
   * The problems of machine, set-up and program.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A program rewritten for the actual machine, with its proof: `trueaxis/compensate-program/1`.
 */
export interface ProgramDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/compensate-program/1";
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The program as it was.
   */
  program: string;
  /**
   * The compensated program.
   */
  output: string;
  /**
   * Blocks that move the tool.
   */
  blocks: number;
  /**
   * Blocks of these that were divided.
   */
  split: number;
  /**
   * Blocks that were written for all of them.
   */
  pieces: number;
  /**
   * Circles that became lines.
   */
  circles_to_lines: number;
  /**
   * Words that were added to blocks.
   */
  words_added: number;
  /**
   * The first thousand of them.
   */
  additions: AddedWord[];
  /**
   * Computed words that have a correction added.
   */
  expressions_corrected: number;
  /**
   * The first thousand of them.
   */
  expressions: CorrectedExpression[];
  /**
   * Whether the written program, read back, keeps the residual: only then it is written.
   */
  proved: boolean;
  /**
   * Blocks of rotary axes alone with a new F, so that they take the same time.
   */
  feeds_changed: number;
  /**
   * Places where an axis reverses by less than its reversal error.
   */
  undecided_reversals: number;
  /**
   * Cuts that begin where no corrected word leads, as after a move to machine zero: their ways are not part of the proof.
   */
  begins_elsewhere: number;
  /**
   * Blocks that stay as they are, by reason.
   */
  left: {
    [k: string]: number;
  };
  /**
   * Places where the tool axis keeps its deviation, by reason.
   */
  axis_left: {
    [k: string]: number;
  };
  /**
   * Whether only the tip was corrected.
   */
  position_only: boolean;
  /**
   * How far the tip may be missed between the ends of blocks, mm.
   */
  residual_mm: number;
  /**
   * How far the tool axis may be missed there, rad.
   */
  residual_axis_rad: number;
  /**
   * The least increments; null if numbers were not rounded.
   */
  increments: IncrementsEntry | null;
  /**
   * The largest deviations of the program as it was.
   */
  before: ResidualEntry;
  /**
   * Of the compensated program, read back.
   */
  after: ResidualEntry;
  /**
   * How many ends of blocks were compared.
   */
  ends_compared: number;
  /**
   * The blocks with the largest deviations after compensation.
   */
  worst_blocks: BlockEntry[];
  /**
   * The largest correction of each axis.
   */
  largest_corrections: AxisCorrection[];
  /**
   * The largest relative change of the path length of the tip in a block. Unit: 1.
   */
  way_change_relative: number;
  /**
   * How well the corrections are known.
   */
  uncertainty: UncertaintyEntry;
  /**
   * What would be left without correction and with a wrong sign.
   */
  convention_check: ConventionEntry[];
  /**
   * What to know of this program.
   */
  remarks: string[];
}
/**
 * Lines that are not what they were.
 */
export interface ChangesEntry {
  /**
   * How many lines have changed.
   */
  changed: number;
  /**
   * How many lines the program had.
   */
  of: number;
  /**
   * The first of them.
   */
  lines: ChangedLine[];
}
/**
 * A line as it was, and what it became.
 */
export interface ChangedLine {
  /**
   * Its number in the program as it was.
   */
  line: number;
  /**
   * As it was.
   */
  was: string;
  /**
   * What it became.
   */
  is: string[];
}
/**
 * Makes the compensation tables of a control.
 */
export interface ServeCompensateTablesRequest {
  /**
   * The machine file.
   */
  machine: string;
  /**
   * The control, such as `sinumerik`.
   */
  target: string;
  /**
   * As `--at`: the position of the other axes.
   */
  at?: string | null;
  /**
   * As `--bound`; `1 um` if it is left out.
   */
  bound?: string | null;
  /**
   * As `--no-kinematics`; false if it is left out.
   */
  no_kinematics?: boolean | null;
  /**
   * Temperatures as `--temperature` takes them.
   */
  temperature?: string | null;
  /**
   * As `--machine-only`; false if it is left out.
   */
  machine_only?: boolean | null;
  /**
   * The study of a test piece or a part that is cut with the tables.
   */
  piece?: string | null;
}
/**
 * Tables of a control.
 */
export interface ServeCompensateTables {
  /**
   * The document of `trueaxis compensate tables`.
   */
  document: TablesDocument;
  /**
   * Its report.
   */
  shown: ShownEntry;
  /**
   * The tables.
   */
  made: MadeEntry;
  /**
   * The problems of the machine.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * Tables of one control, and what they leave of the errors: `trueaxis/compensate-tables/1`.
 */
export interface TablesDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/compensate-tables/1";
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The control, as `--target` names it.
   */
  target: string;
  /**
   * The files that were written.
   */
  files: string[];
  /**
   * The values are added to the command.
   */
  added_to: string;
  /**
   * Where the other axes stand for each table, mm and deg.
   */
  reference: {
    [k: string]: number;
  };
  /**
   * The tables.
   */
  tables: TableEntry[];
  /**
   * Errors that the control's own chain holds.
   */
  known: KnownEntry[];
  /**
   * Lines by which the control follows temperatures.
   */
  temperature: LineEntry[];
  /**
   * Rotary axes in the control's kinematics.
   */
  kinematics: JointEntry[];
  /**
   * The grid of corrections in space; null if there is none.
   */
  grid: GridEntry | null;
  /**
   * What was left out, and why.
   */
  left_out: LeftOutEntry[];
  /**
   * The errors that the tables represent.
   */
  represents: string[];
  /**
   * The errors that they cannot represent.
   */
  cannot: LossEntry[];
  /**
   * Deviation of the tool over the travel without tables, µm.
   */
  before_um: ServeCompensateTablesResidualEntry;
  /**
   * The same with the tables, µm.
   */
  left_um: ProvedEntry;
  /**
   * The same after the part zero was set with the tables in force, the axes at `reference`, µm.
   */
  left_zero_set_um: ServeCompensateTablesResidualEntry;
  /**
   * The same if the control took them with the wrong sign, µm.
   */
  wrong_sign_um: ServeCompensateTablesResidualEntry;
  /**
   * What to do at the control.
   */
  notes: string[];
  /**
   * What tables of the machine alone can cost; present only where the temperature of the workpiece is not
   * known.
   */
  machine_only?: string | null;
}
/**
 * Deviation of the tool over the travel of all axes.
 */
export interface ServeCompensateTablesResidualEntry {
  /**
   * The largest of the tip. Unit: µm.
   */
  max: number;
  /**
   * Root mean square of the tip. Unit: µm.
   */
  rms: number;
  /**
   * Where the largest is, mm and deg.
   */
  at: {
    [k: string]: number;
  };
  /**
   * How many poses, each from both sides.
   */
  poses: number;
  /**
   * The largest of the tool axis, µrad.
   */
  axis_urad: number;
}
/**
 * The controls that tables can be made for.
 */
export interface ServeCompensateTargetsRequest {}
/**
 * A control that tables can be made for.
 */
export interface ServeCompensateTargetsTargetEntry {
  /**
   * Its name in requests, and after `--target` of the command line.
   */
  key: string;
  /**
   * What it is, and which files it reads.
   */
  title: string;
}
/**
 * Calculates values per axis and position.
 */
export interface ServeCompensateValuesRequest {
  /**
   * The machine file.
   */
  machine: string;
  /**
   * The axis of a table over the travel.
   */
  axis: string;
  /**
   * As `--at`: the position of the other axes.
   */
  at?: string | null;
  /**
   * As `--step`: distance of the positions, mm or degrees.
   */
  step?: string | null;
  /**
   * As `--increment`: the least increment of the control, with its unit.
   */
  increment?: string | null;
  /**
   * As `--of`: the error of the machine alone, or machine − workpiece; the latter if it is left out.
   */
  of?: CompensatedError | null;
  /**
   * Temperatures as `--temperature` takes them.
   */
  temperature?: string | null;
  /**
   * As `--machine-only`; false if it is left out.
   */
  machine_only?: boolean | null;
}
/**
 * Values of one axis.
 */
export interface ServeCompensateValues {
  /**
   * The document of `trueaxis compensate values`.
   */
  document: CompensationDocument;
  /**
   * Its report.
   */
  shown: ShownEntry;
  /**
   * The values as CSV.
   */
  made: MadeEntry;
  /**
   * The problems of the machine.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * Values that the control has to add to its commands: `trueaxis/compensate/1`.
 */
export interface CompensationDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/compensate/1";
  /**
   * `values`.
   */
  what: string;
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The values are added to the command.
   */
  added_to: string;
  /**
   * One entry for each axis.
   */
  axes: AxisValues[];
  /**
   * Where compensating the machine alone makes the part worse, or can.
   */
  warnings: string[];
}
/**
 * The machine as data; of one that cannot be used, what is wrong with it.
 */
export interface ServeDescribeRequest {
  /**
   * The machine file.
   */
  machine: string;
  /**
   * Its text, if it is being edited.
   */
  text?: string | null;
}
/**
 * A machine.
 */
export interface ServeDescribe {
  /**
   * The bodies of the kinematic chain.
   */
  links: LinkEntry[];
  /**
   * The errors of the machine, those without a stated value too.
   */
  errors: ErrorEntry[];
  /**
   * Its temperature sensors.
   */
  sensors: SensorEntry[];
  /**
   * The tool in the spindle; absent where there is no machine.
   */
  tool?: MountedToolEntry | null;
  /**
   * The tools of the machine file.
   */
  tools: ToolAssemblyEntry[];
  /**
   * The models of its bodies.
   */
  models: ModelEntry[];
  /**
   * Whether it can be used, and the problems of its file.
   */
  check: CheckDocument;
  /**
   * The version of the text, for `save`.
   */
  version: string;
  /**
   * The text of the machine file.
   */
  text: string;
}
/**
 * A machine file, checked.
 */
export interface CheckDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/check/1";
  /**
   * Whether the file can be used, perhaps with warnings.
   */
  usable: boolean;
  /**
   * The name of the machine.
   */
  name?: string;
  /**
   * Its kinematic chain from the workpiece to the tool.
   */
  chain?: string;
  /**
   * Where its data are from.
   */
  source?: string;
  /**
   * Its axes in chain order.
   */
  axes?: AxisEntry[];
  /**
   * Its coordinate systems with all axes at 0, without errors.
   */
  frames?: FrameEntry[];
  /**
   * Limits of spindle and magazine; absent where the file states none.
   */
  equipment?: EquipmentEntry | null;
  /**
   * The names of its tools.
   */
  tools?: string[];
  /**
   * The ISO 230-1 names of the errors that are stated.
   */
  errors?: string[];
  /**
   * The measurements that the errors are from.
   */
  measured?: MeasurementEntry[];
  /**
   * What a prediction or a simulation would need in addition, in words.
   */
  lacks?: string[];
  /**
   * The problems of the file.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * Evaluates readings: `path` names their file, or `name` and `text` are a file that was dropped.
 */
export interface ServeEvaluateRequest {
  /**
   * The standard, such as `iso230-2`.
   */
  standard: string;
  /**
   * The file of the readings.
   */
  path?: string | null;
  /**
   * The name of a file that was dropped.
   */
  name?: string | null;
  /**
   * Its text.
   */
  text?: string | null;
  /**
   * The format of the file; by its ending if it is left out.
   */
  import?: string | null;
  /**
   * The feature of a QIF file.
   */
  feature?: string | null;
  /**
   * The file of the conditions; the one beside the readings if it is left out.
   */
  conditions?: string | null;
  /**
   * The radius of a circular test, a length with its unit.
   */
  radius?: string | null;
  /**
   * The window of a drift test, a time with its unit.
   */
  window?: string | null;
  /**
   * The text of a mapping file that counts instead of the one beside the readings.
   */
  mapping?: string | null;
  /**
   * The text of conditions that count instead of those of a file.
   */
  stated?: string | null;
  /**
   * Tolerances, such as `A=10 um`.
   */
  tolerances?: string[] | null;
  /**
   * Whether a value alone decides, without its uncertainty.
   */
  is_simple?: boolean | null;
}
/**
 * An evaluation. Arrays: `line` (f64: x, y and half the width of the band for each point of the bands), `points`
 * (f64: x and y of each point; in polar pictures angle, rad, and radial deviation, µm).
 */
export interface ServeEvaluate {
  /**
   * The document of `trueaxis evaluate`.
   */
  document: Diagnosed;
  /**
   * The text of `trueaxis evaluate`.
   */
  text: string;
  /**
   * The file of the conditions below the project folder; null if there is none.
   */
  conditions_file: string | null;
  /**
   * The tables of the results.
   */
  figures: ServeEvaluateTableEntry[];
  /**
   * Further tables.
   */
  details: ServeEvaluateTableEntry[];
  /**
   * The pictures.
   */
  pictures: PictureEntry[];
  /**
   * Warnings and notes, each as one text.
   */
  remarks: string[];
  /**
   * The same with code and place.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A table of a report.
 */
export interface ServeEvaluateTableEntry {
  /**
   * Its title.
   */
  title: string;
  /**
   * The text below it; may be empty.
   */
  note: string;
  /**
   * The headings with their units.
   */
  headings: string[];
  /**
   * The cells, row by row.
   */
  rows: string[][];
  /**
   * For each column, whether it contains words.
   */
  words: boolean[];
}
/**
 * A series of a picture.
 */
export interface BandEntry {
  /**
   * Its name in the legend.
   */
  label: string;
  /**
   * Its colour, from 0.
   */
  colour: number;
  /**
   * Its line, as a part of `line`.
   *
   * @minItems 2
   * @maxItems 2
   */
  line: [number, number];
  /**
   * Its points, as a part of `points`.
   *
   * @minItems 2
   * @maxItems 2
   */
  points: [number, number];
}
/**
 * A curve around a circle.
 */
export interface PolarLineEntry {
  /**
   * Its name in the legend.
   */
  label: string;
  /**
   * Its colour, from 0.
   */
  colour: number;
  /**
   * Its points, as a part of `points`.
   *
   * @minItems 2
   * @maxItems 2
   */
  points: [number, number];
}
/**
 * The errors of a machine from the readings of a campaign.
 */
export interface ServeIdentifyRequest {
  /**
   * The campaign file.
   */
  campaign: string;
  /**
   * The instrument that `text` belongs to; needed where the campaign has several.
   */
  instrument?: string | null;
  /**
   * The name of the file that was dropped.
   */
  name?: string | null;
  /**
   * Its text: readings in place of those of the instrument.
   */
  text?: string | null;
}
/**
 * An identification. Arrays: `correlation` (f64: row by row), `at_mm` (f64: three for each reading), `before_um`,
 * `after_um` (f32: three for each reading, without and with the identified errors).
 */
export interface ServeIdentify {
  /**
   * The document of `trueaxis identify`.
   */
  document: ServeIdentifyDiagnosed;
  /**
   * The machine file below the project folder; null if it is outside.
   */
  machine: string | null;
  /**
   * The instruments of the campaign.
   */
  instruments: ServeIdentifyInstrumentEntry[];
  /**
   * The names of the unknowns, in the order of the correlation matrix.
   */
  correlation: string[];
  /**
   * The machine file with the identified errors; null if it cannot be edited.
   */
  machine_file: MachineFileEntry | null;
  /**
   * The problems of the campaign and its readings.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A document of the command line with the problems of its input.
 */
export interface ServeIdentifyDiagnosed {
  /**
   * Which document this is.
   */
  schema: "trueaxis/identify/1";
  /**
   * Name of the campaign.
   */
  name: string;
  /**
   * Name of the machine.
   */
  machine: string;
  /**
   * Date of the measurement as written; null if none is stated.
   */
  date: string | null;
  /**
   * Whether the model explains the readings.
   */
  verdict: VerdictEntry;
  /**
   * The stages one after the other; empty if the campaign has none.
   */
  stages: StageEntry[];
  /**
   * The largest difference between the stages and all readings at once, in standard uncertainties; null
   * without stages. Unit: 1.
   */
  stages_differ_by_u: number | null;
  /**
   * The errors of the machine.
   */
  errors: FoundEntry[];
  /**
   * The errors of the set-up of the instruments.
   */
  setup: FoundEntry[];
  /**
   * Combinations of errors that change no reading.
   */
  unobservable: Unobservable[];
  /**
   * Candidate terms that the readings do not support.
   */
  left_out: string[];
  /**
   * Root mean square of the residual of length readings, in sample, µm; null without such readings.
   */
  rms_in_um: number | null;
  /**
   * The same on places that the model had not seen, µm.
   */
  rms_held_out_um: number | null;
  /**
   * Repeatability of the readings, µm.
   */
  repeatability_um: number | null;
  /**
   * Whether the repeatability comes from repeated readings; if not, it is the stated noise.
   */
  repeatability_is_measured: boolean;
  /**
   * Root mean square without the unknown errors, set-up only, µm.
   */
  rms_without_model_um: number | null;
  /**
   * The same figures for lengths and angles.
   */
  rms: RmsEntries;
  /**
   * Number of readings.
   */
  readings: number;
  /**
   * Number of places.
   */
  places: number;
  /**
   * Rank of the design matrix.
   */
  rank: number;
  /**
   * Its condition number. Unit: 1.
   */
  condition: number;
  /**
   * Relative singular value below which a combination counts as unobservable. Unit: 1.
   */
  threshold: number;
  /**
   * `full` or `linear`.
   */
  model: string;
  /**
   * χ² of the fit. Unit: 1.
   */
  chi_square: number;
  /**
   * Its degrees of freedom.
   */
  degrees_of_freedom: number;
  /**
   * The feeds of the readings, and the lags that they cannot separate.
   */
  feeds: Feeds;
  /**
   * Factor by which the uncertainties are enlarged, 1 or more. Unit: 1.
   */
  birge_ratio: number;
  /**
   * The test of the residual.
   */
  test: TestEntry;
  /**
   * The largest coverage factor of the values. Unit: 1.
   */
  coverage_factor: number;
  /**
   * What the residual follows, the most evident first.
   */
  residual_follows: ServeIdentifyFieldEntry[];
  /**
   * How well readings are predicted; null if that was not asked for.
   */
  prediction: PredictionEntry | null;
  /**
   * How the terms were selected.
   */
  selection: SelectionEntry;
  /**
   * Readings beyond the limit of studentised residuals.
   */
  outliers: ServeIdentifyOutlierEntry[];
  /**
   * That limit, in standard deviations. Unit: 1.
   */
  outlier_limit: number;
  /**
   * The readings that change the result most if they are left out.
   */
  most_influential: InfluenceEntry[];
  /**
   * The conventions that were tried; null if that was not asked for.
   */
  conventions: ConventionCheck | null;
  /**
   * The problems found in the input.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A part of the residual.
 */
export interface ServeIdentifyFieldEntry {
  /**
   * The letter of an axis, `arrangement` (location errors), `approach` or `time`.
   */
  what: string;
  /**
   * The share of the squares of the residual that this kind of error, which is not listed, would explain alone,
   * 0 to 1. Unit: 1.
   */
  share: number;
}
/**
 * A reading that does not fit.
 */
export interface ServeIdentifyOutlierEntry {
  /**
   * Its file.
   */
  file: string;
  /**
   * Its line there.
   */
  line: number;
  /**
   * Its channel, from 1.
   */
  channel: number;
  /**
   * Its studentised residual. Unit: 1.
   */
  studentised: number;
}
/**
 * An instrument.
 */
export interface ServeIdentifyInstrumentEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its kind, as campaign files call it.
   */
  kind: string;
  /**
   * The names of its channels.
   */
  channels: string[];
  /**
   * The files of its readings below the project folder.
   */
  tables: string[];
}
/**
 * A machine file with the tables of its errors.
 */
export interface MachineFileEntry {
  /**
   * Its text.
   */
  text: string;
  /**
   * Its tables.
   */
  tables: TextEntry[];
}
/**
 * A file by name and text.
 */
export interface TextEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its text.
   */
  text: string;
}
/**
 * The state of a live run.
 */
export interface ServeLiveRequest {
  /**
   * The plan of the run.
   */
  plan: string;
  /**
   * The last hours, too. Unit: h.
   */
  hours?: number | null;
}
/**
 * The state of a live run.
 */
export interface ServeLive {
  /**
   * The document of `trueaxis live status`.
   */
  document: ServeLiveDiagnosed;
  /**
   * The date of this answer, seconds since 1970 (UTC): by it the page says how old a state is.
   */
  now_s: number;
}
/**
 * A document of the command line with the problems of its input.
 */
export interface ServeLiveDiagnosed {
  /**
   * Which document this is.
   */
  schema: "trueaxis/live-status/1";
  /**
   * The name of the plan.
   */
  name: string;
  /**
   * Whether a run is going on now.
   */
  running: boolean;
  /**
   * The last state that is known; null if the plan never ran here.
   */
  last: LiveState | null;
  /**
   * The last changes of state, the oldest first.
   */
  events: LiveEventEntry[];
  /**
   * The last hours; null if they were not asked for.
   */
  history: LiveHistory | null;
  /**
   * The problems found in the input.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * Looks at readings while they are taken.
 */
export interface ServeMeasureCheckRequest {
  /**
   * The campaign file.
   */
  campaign: string;
  /**
   * The instrument.
   */
  instrument: string;
  /**
   * The name of the table, for messages.
   */
  name: string;
  /**
   * The table: CSV as `identify` takes it.
   */
  text: string;
}
/**
 * What the readings so far say.
 */
export interface ServeMeasureCheck {
  /**
   * How many readings.
   */
  readings: number;
  /**
   * In how many places.
   */
  places: number;
  /**
   * How many of these were read more than once.
   */
  repeated: number;
  /**
   * Each channel; empty where nothing was repeated.
   */
  channels: RepeatedChannel[];
  /**
   * The problems of the table.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * The repeatability of a channel.
 */
export interface RepeatedChannel {
  /**
   * The channel.
   */
  channel: string;
  /**
   * `um` or `urad`.
   */
  unit: string;
  /**
   * The standard deviation of readings in one place, from all places with several. Unit: that of `unit`.
   */
  s: number;
  /**
   * Its degrees of freedom.
   */
  degrees_of_freedom: number;
  /**
   * The largest difference of two readings in one place. Unit: that of `unit`.
   */
  largest_range: number;
  /**
   * The noise that the campaign states. Unit: that of `unit`.
   */
  stated: number;
}
/**
 * Measures a campaign on a machine that exists only as a file: that of its `[truth]`.
 */
export interface ServeMeasureRequest {
  /**
   * The campaign file.
   */
  campaign: string;
  /**
   * The random seed instead of that of `[truth]`.
   */
  seed?: number | null;
}
/**
 * The sheets of a campaign: one table for each instrument, its readings still empty.
 */
export interface ServeMeasureSheetRequest {
  /**
   * The campaign file.
   */
  campaign: string;
}
/**
 * What is to be measured.
 */
export interface ServeMeasureSheet {
  /**
   * The name of the campaign.
   */
  name: string;
  /**
   * The name of the machine.
   */
  machine: string;
  /**
   * The machine file below the project folder; null if it is outside.
   */
  machine_file: string | null;
  /**
   * A sheet for each instrument that has stations.
   */
  sheets: SheetEntry[];
  /**
   * The problems of the campaign.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * The stations of one instrument, as `identify` reads them.
 */
export interface SheetEntry {
  /**
   * The instrument.
   */
  instrument: string;
  /**
   * Its kind, as campaign files call it.
   */
  kind: string;
  /**
   * Where the campaign has its readings, else where they can be saved: below the project folder.
   */
  file: string;
  /**
   * Whether the campaign names that file.
   */
  named: boolean;
  /**
   * Whether it is there.
   */
  there: boolean;
  /**
   * The columns.
   */
  columns: SheetColumn[];
  /**
   * The stations in their order: the cells of the columns; those of readings are empty.
   */
  rows: string[][];
  /**
   * The paths, in the order of the rows.
   */
  paths: SheetPath[];
}
/**
 * A column of a sheet.
 */
export interface SheetColumn {
  /**
   * Its heading, with its unit, such as `x_um`; axes by their letters, mm or degrees.
   */
  name: string;
  /**
   * Whether it is read, not commanded.
   */
  read: boolean;
}
/**
 * The stations of one path.
 */
export interface SheetPath {
  /**
   * Its name.
   */
  name: string;
  /**
   * How many stations it has.
   */
  stations: number;
}
/**
 * What the instruments would read.
 */
export interface ServeMeasure {
  /**
   * The document of `trueaxis measure`.
   */
  document: MeasurementDocument;
  /**
   * Its report.
   */
  shown: ShownEntry;
  /**
   * The readings of each instrument, then what is true.
   */
  made: MadeEntry;
  /**
   * The problems of the campaign.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * The readings of a virtual machine.
 */
export interface MeasurementDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/measure/1";
  /**
   * Name of the campaign.
   */
  name: string;
  /**
   * Name of the machine.
   */
  machine: string;
  /**
   * Seed of the random numbers.
   */
  seed: number;
  /**
   * Duration of the measurement, s.
   */
  time_s: number;
  /**
   * Number of readings.
   */
  readings: number;
  /**
   * Number of readings that were lost.
   */
  lost: number;
  /**
   * The instruments of the campaign.
   */
  instruments: InstrumentEntry[];
  /**
   * Every channel of every instrument on every path.
   */
  channels: ServeMeasureChannelEntry[];
  /**
   * The files that were written.
   */
  files: string[];
}
/**
 * Reading less nominal reading of one channel on one path.
 */
export interface ServeMeasureChannelEntry {
  /**
   * The path.
   */
  path: string;
  /**
   * The instrument.
   */
  instrument: string;
  /**
   * The channel.
   */
  channel: string;
  /**
   * Number of readings.
   */
  count: number;
  /**
   * Row of the largest deviation, from 0.
   */
  largest_row: number;
  [k: string]: number;
}
/**
 * The surfaces of the models of a machine, those of STL files too.
 */
export interface ServeModelsRequest {
  /**
   * The machine file.
   */
  machine: string;
  /**
   * Its text, if it is being edited.
   */
  text?: string | null;
}
/**
 * Models. Array: `corners_mm` (f32: the corners of the triangles, nine numbers each, model after model).
 */
export interface ServeModels {
  /**
   * The models.
   */
  models: SurfaceEntry[];
  /**
   * The problems of the machine file and its models.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A model as triangles.
 */
export interface SurfaceEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * The body that it moves with, as an index of the links; null is the bed.
   */
  body: number | null;
  /**
   * Its pose on that body: rotation row by row, then origin, mm.
   *
   * @minItems 12
   * @maxItems 12
   */
  placement: [number, number, number, number, number, number, number, number, number, number, number, number];
  /**
   * How many triangles it has.
   */
  triangles: number;
}
/**
 * The text of a new machine file; nothing is saved.
 */
export interface ServeNewMachineRequest {
  /**
   * What the rotary axes carry: `three-axis`, `table-table`, `head-head`, `head-table`.
   */
  kind: string;
  /**
   * The name of the machine.
   */
  name: string;
  /**
   * Linear axes that carry the workpiece; as in the template of the kind if it is left out.
   */
  workpiece?: string[] | null;
  /**
   * The rotary axis that tilts, `A` or `B`.
   */
  tilting?: string | null;
  /**
   * Travels by axis, from and to, mm or deg; null: all around. As in the template if an axis is left out.
   */
  travels?: {
    /**
     * @minItems 2
     * @maxItems 2
     */
    [k: string]: [number, number] | null;
  } | null;
  /**
   * Axes whose plus is against ISO 841.
   */
  reversed?: string[] | null;
  /**
   * The reference line of Z at Z = 0 above the origin of the machine frame, mm.
   */
  height_mm?: number | null;
}
/**
 * A new machine file.
 */
export interface ServeNewMachine {
  /**
   * Its text.
   */
  text: string;
}
/**
 * The text of a file.
 */
export interface ServeOpenRequest {
  /**
   * Its path below the project folder.
   */
  path: string;
}
/**
 * A file as it is on the disk.
 */
export interface ServeOpen {
  /**
   * Its path below the project folder.
   */
  path: string;
  /**
   * Its text; what is not UTF-8 is shown as replacement characters.
   */
  text: string;
  /**
   * The version of the text, for `save`.
   */
  version: string;
}
/**
 * The plan of a campaign: paths, programs, expected uncertainties.
 */
export interface ServePlanRequest {
  /**
   * The campaign file.
   */
  campaign: string;
  /**
   * The control that the programs are for, as `--control` of the command line; `sinumerik` if it is left out.
   */
  dialect?: string | null;
}
/**
 * A plan. Arrays: `commands` (f64: the axis positions of all stations of all paths, mm and degrees), `tools`
 * (f64: for each station the tip, mm, then the tool axis, both in the workpiece frame).
 */
export interface ServePlan {
  /**
   * The document of `trueaxis plan`.
   */
  document: PlanDocument;
  /**
   * The machine file below the project folder; null if it is outside.
   */
  machine: string | null;
  /**
   * The axes in the order of the commands.
   */
  axes: AxisUnitEntry[];
  /**
   * The paths, in the order of the arrays.
   */
  paths: PlannedPathEntry[];
  /**
   * The problems found in the campaign.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * What a campaign will show before anybody measures.
 */
export interface PlanDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/plan/1";
  /**
   * Name of the campaign.
   */
  name: string;
  /**
   * Name of the machine.
   */
  machine: string;
  /**
   * The kinematic chain of the machine.
   */
  chain: string;
  /**
   * The paths and their programs.
   */
  paths: ServePlanPathEntry[];
  /**
   * What each stage will determine; empty if the campaign has none.
   */
  stages: PlannedStageEntry[];
  /**
   * The uncertainty to expect of each unknown.
   */
  expected: ExpectedEntry[];
  /**
   * Combinations of unknowns that change no reading.
   */
  unobservable: Unobservable[];
  /**
   * Number of combinations of unknowns that are observable.
   */
  rank: number;
  /**
   * Condition number of the design matrix. Unit: 1.
   */
  condition: number;
  /**
   * The choice of poses; null if none was asked for.
   */
  chosen: ChosenEntry | null;
}
/**
 * A path and its program.
 */
export interface ServePlanPathEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Number of stations.
   */
  stations: number;
  /**
   * Feed if it is read while moving, mm/min; else null.
   */
  feed_mm_per_min: number | null;
  /**
   * Dwell at each station, s.
   */
  dwell_s: number;
  /**
   * Channels of the instrument.
   */
  channels: string[];
  /**
   * Unit of the readings below: `um` or `urad`.
   */
  unit: string;
  /**
   * The largest reading that 10 µm or 10 µrad of each error causes.
   */
  seen_of_10_um_or_urad: SeenEntry[];
  /**
   * The check of its program, or why there is none.
   */
  program: ServePlanProgramEntry;
}
/**
 * An axis with the unit of its positions.
 */
export interface AxisUnitEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * The unit.
   */
  unit: "mm" | "deg";
}
/**
 * A path of the plan.
 */
export interface PlannedPathEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its instrument.
   */
  instrument: string;
  /**
   * The kind of the instrument.
   */
  kind: string;
  /**
   * How many stations it has.
   */
  stations: number;
  /**
   * Its programs.
   */
  files: TextEntry[];
}
/**
 * Nominal and actual place of the tool and of every body at one position of the axes.
 */
export interface ServePoseRequest {
  /**
   * The machine file.
   */
  machine: string;
  /**
   * Its text, if it is being edited.
   */
  text?: string | null;
  /**
   * The position by axis name, mm and degrees; an axis that is left out is at 0.
   */
  at?: {
    [k: string]: number;
  } | null;
  /**
   * The length of the tool, mm; that of the machine file if it is left out.
   */
  tool_length_mm?: number | null;
  /**
   * Temperatures, as `--temperature` of the command line.
   */
  temperature?: string | null;
}
/**
 * A pose. Arrays: `nominal`, `actual` (f64: for each body its rotation row by row, then its origin, mm, in the
 * machine frame).
 */
export interface ServePose {
  /**
   * The document of `trueaxis pose`.
   */
  pose: PoseDocument;
  /**
   * The names of the bodies, in the order of the arrays.
   */
  bodies: string[];
  /**
   * The problems of the machine file and of the position.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * The tool at one position of the axes.
 */
export interface PoseDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/pose/1";
  /**
   * As the control commands it.
   */
  nominal: ToolPoseEntry;
  /**
   * As the machine with its errors moves it.
   */
  actual: ToolPoseEntry;
  /**
   * Actual − nominal.
   */
  deviation: ServePoseDeviationEntry;
  /**
   * The deviation under each error alone.
   */
  budget: ShareEntry[];
  /**
   * Nominal and actual place of every body; absent unless it was asked for.
   */
  bodies?: BodyEntry[] | null;
  /**
   * By the name of the cause: `geometric`, `scale`, `structure`, `workpiece`.
   */
  split?: {
    [k: string]: TipEntry;
  };
  /**
   * Of the machine without the growth of the workpiece.
   */
  machine?: TipEntry;
  /**
   * Of all together.
   */
  comprehensive?: ComprehensiveEntry;
  /**
   * How fast the workpiece takes the temperature of the air; absent where that is not stated.
   */
  settling?: SettlingEntry | null;
}
/**
 * A deviation of the tool.
 */
export interface ServePoseDeviationEntry {
  /**
   * Of the tip, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_um: [number, number, number];
  /**
   * Of the axis, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  axis_urad: [number, number, number];
}
/**
 * The whole prediction of a study, as `trueaxis predict --no-report` computes it.
 */
export interface ServePredictRequest {
  /**
   * The study file: a test piece, holes or a part.
   */
  study: string;
  /**
   * Of a part, whether it is judged by its program compensated for the machine, too; no, if left out.
   */
  compensated?: boolean | null;
}
/**
 * The prediction of a test piece. Arrays: for each point of all sections `azimuth_rad` (f32), `error_um` (f32:
 * the radial deviation) and `profile_mm` (f64: two, the actual point in the section).
 */
export interface ServePredictPieceEntry {
  /**
   * The document of `trueaxis predict`.
   */
  document: PredictionDocument;
  /**
   * The machine file below the project folder; null if it is outside.
   */
  machine: string | null;
  /**
   * The names of the rotary axes.
   */
  rotary: string[];
  /**
   * The length of the tool, mm.
   */
  tool_length_mm: number;
  /**
   * The stated errors.
   */
  errors: ErrorUnitEntry[];
  /**
   * The names of the temperature sensors.
   */
  sensors: string[];
  /**
   * The sections, in the order of the arrays.
   */
  sections: SectionEntry[];
  /**
   * The problems of the study.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A test piece before it is cut: `trueaxis/predict/1`.
 */
export interface PredictionDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/predict/1";
  /**
   * The version of TrueAxis.
   */
  version: string;
  /**
   * The name of the study.
   */
  study: string;
  /**
   * The machine.
   */
  machine: ServeWhatIfMachineEntry;
  /**
   * The name of the test piece.
   */
  test_piece: string;
  /**
   * `pass`, `fail` or `undecided`.
   */
  verdict: string;
  /**
   * The indices, those of ISO under `iso`, those of the paper under `paper`, mm.
   */
  indices: {
    [k: string]: Grouped;
  };
  /**
   * The tolerances with their verdicts.
   */
  judgements: JudgementEntry[];
  /**
   * Where the axes stand when the zero is set, mm and deg.
   */
  setting_command: {
    [k: string]: number;
  };
  /**
   * The form at each measuring position.
   */
  positions: ServeWhatIfPositionEntry[];
  /**
   * The share of each error in each index, the largest first.
   */
  blame: ServeWhatIfShareEntry[];
  /**
   * The same with all errors of a body together.
   */
  blame_by_body: ServeWhatIfShareEntry[];
  /**
   * The same with all location errors and all error motions together.
   */
  blame_by_kind: ServeWhatIfShareEntry[];
  /**
   * Slopes of the indices by each location error.
   */
  sensitivity: SensitivityEntry[];
  /**
   * Single corrections after which the part would pass, the smallest first.
   */
  corrections: CorrectionEntry[];
  /**
   * The same part with other setting points and datums.
   */
  variants: VariantEntry[];
  /**
   * Axis positions of all tool positions, mm and deg.
   */
  commands: {
    [k: string]: number;
  }[];
  /**
   * The Monte Carlo run; null if there was none.
   */
  monte_carlo: SamplingEntry | null;
  /**
   * The log that the temperatures follow; null if there is none.
   */
  temperature_log: string | null;
  /**
   * The part at the feed of every cutting condition; absent without `[servo]`.
   */
  conditions?: ConditionEntry[];
  /**
   * What to know of this prediction.
   */
  warnings: string[];
}
/**
 * The machine.
 */
export interface ServeWhatIfMachineEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its chain from the workpiece to the tool.
   */
  chain: string;
}
/**
 * The form at one measuring position.
 */
export interface ServeWhatIfPositionEntry {
  /**
   * Its number, from 1.
   */
  position: number;
  /**
   * Its place along the axis of the part in the workpiece frame, mm.
   */
  z_mm: number;
  /**
   * Its height above the base, mm.
   */
  height_mm: number;
  /**
   * The nominal radius, mm.
   */
  nominal_radius_mm: number;
  /**
   * Where the form is given, deg.
   */
  azimuth_deg: number[];
  /**
   * The error there, positive where material is left, mm.
   */
  e_mm: number[];
  [k: string]: Grouped2;
}
/**
 * The share of an error, or of a group of errors, in an index.
 */
export interface ServeWhatIfShareEntry {
  /**
   * The ISO 230-1 name, or the name of the group.
   */
  error: string;
  /**
   * The key of the index.
   */
  index: string;
  /**
   * The index if there were only this error, mm.
   */
  alone_mm: number;
  /**
   * The index without this error, mm.
   */
  without_mm: number;
}
/**
 * A stated error with the unit of its values.
 */
export interface ErrorUnitEntry {
  /**
   * Its ISO 230-1 name.
   */
  name: string;
  /**
   * `µm` or `µrad`.
   */
  unit: string;
}
/**
 * A measured section of the test piece.
 */
export interface SectionEntry {
  /**
   * Its height in the workpiece frame, mm.
   */
  z_mm: number;
  /**
   * Its height above the base of the cone, mm.
   */
  height_mm: number;
  /**
   * Its nominal radius, mm.
   */
  radius_mm: number;
  /**
   * How many points it has.
   */
  points: number;
  /**
   * The reference circles.
   *
   * @minItems 4
   * @maxItems 4
   */
  circles: [CircleEntry, CircleEntry, CircleEntry, CircleEntry];
}
/**
 * A reference circle of a section.
 */
export interface CircleEntry {
  /**
   * `least squares`, `minimum zone`, `maximum inscribed` or `minimum circumscribed`.
   */
  name: string;
  /**
   * Its centre, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  centre_mm: [number, number];
  /**
   * Its radius, mm.
   */
  radius_mm: number;
  /**
   * The distance of the nearest point from the centre, mm.
   */
  inner_mm: number;
  /**
   * The distance of the farthest point from the centre, mm.
   */
  outer_mm: number;
}
/**
 * The prediction of holes. Arrays: `holes_mm` (f64: the three nominal coordinates of each hole), `error_um` (f32:
 * the three errors of each hole, set after set).
 */
export interface HolesEntry {
  /**
   * The document of `trueaxis predict`.
   */
  document: HolesDocument;
  /**
   * The names of the temperature sensors.
   */
  sensors: string[];
  /**
   * The problems of the study.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * Holes before they are made, under each compensation: `trueaxis/predict/1`.
 */
export interface HolesDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/predict/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The least increment of the control, mm.
   */
  increment_mm: number;
  /**
   * The tolerance of the place of a hole; null if none is stated, mm.
   */
  tolerance_mm: number | null;
  /**
   * The tolerance of the location diameter, either way; null if none is stated, mm.
   */
  location_tolerance_mm: number | null;
  /**
   * The compensation that is applied: `none`, `machine`, `comprehensive`, or `acted`: what a live run has recorded.
   */
  applied: string;
  /**
   * Whether all stated tolerances are kept with it; null if none is stated.
   */
  in_tolerance: boolean | null;
  /**
   * The log that the temperatures follow; null if there is none.
   */
  temperature_log: string | null;
  /**
   * The record of what acted; null without one.
   */
  acted_record: string | null;
  /**
   * The holes under each compensation.
   */
  sets: SetEntry[];
  /**
   * The same at the temperatures of the start, held; null where no log runs.
   */
  sets_at_start: SetEntry[] | null;
  /**
   * What grows with the temperature though the uncertainty of its coefficient is not stated: u lacks it.
   */
  u_lacks: string[];
  /**
   * What to know of this prediction.
   */
  warnings: string[];
}
/**
 * The prediction of a part by its drawing. Arrays, point after point of all features: `places_mm` (f32: three nominal
 * coordinates each), `normals` (f32: three each, out of the material), `deviation_um`, `by_program_um` (f32: on a machine without
 * errors), `tool`, `program`, `line` (u32: the block that cut it), `time_s` (f32), and of the four errors that displace it most
 * `error` (u32: the number of its name in `error_names`; where there are fewer, of none) and `part_um` (f32).
 */
export interface DrawingEntry {
  /**
   * The document of `trueaxis predict`.
   */
  document: DrawingDocument;
  /**
   * The files of the program, by their number in `program`.
   */
  programs: string[];
  /**
   * The names of the errors, by their number in `error`.
   */
  error_names: string[];
  /**
   * The problems of the study.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A part before it is cut, judged by its drawing: `trueaxis/predict/1`.
 */
export interface DrawingDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/predict/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * The name of the part.
   */
  part: string;
  /**
   * `pass`, `fail`, or `undecided` within the uncertainty.
   */
  outcome: string;
  /**
   * The same by the compensated program, the zero where it was set; absent unless it was asked for.
   */
  compensated_outcome?: string | null;
  /**
   * The same with the zero set again by compensated motion.
   */
  compensated_zero_set_outcome?: string | null;
  /**
   * Errors each of whose corrections alone brings all characteristics into tolerance, the best first; empty where they are.
   */
  sufficient: string[];
  /**
   * Steps of the tools.
   */
  steps: number;
  /**
   * Errors of the machine file without a stated uncertainty; they add nothing to `u_mm`.
   */
  errors_without_u: string[];
  /**
   * The Monte Carlo run; absent if there was none.
   */
  monte_carlo?: ManyEntry | null;
  /**
   * The lines of the drawing, in the order of the part file.
   */
  characteristics: CharacteristicEntry[];
  /**
   * The features, in the order of the part file.
   */
  features: FeatureEntry[];
}
/**
 * Which files and examples there are.
 */
export interface ServeProjectRequest {}
/**
 * The project folder.
 */
export interface ServeProject {
  /**
   * The name of the folder.
   */
  folder: string;
  /**
   * The version of TrueAxis.
   */
  version: string;
  /**
   * The examples of the folder.
   */
  examples: ExampleEntry[];
  /**
   * Its files in the order of their paths.
   */
  files: ServeProjectFileEntry[];
  /**
   * Whether there are more files than are listed.
   */
  more_files: boolean;
  /**
   * Problems of the list of examples.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * An example of the project.
 */
export interface ExampleEntry {
  /**
   * The tab that shows it.
   */
  tab: string;
  /**
   * Its title.
   */
  title: string;
  /**
   * What it shows, in a sentence.
   */
  what: string;
  /**
   * Its file.
   */
  path: string;
  /**
   * The machine file that it needs.
   */
  machine?: string | null;
  /**
   * The standard by which its readings are evaluated.
   */
  standard?: string | null;
}
/**
 * A file that the page has a use for.
 */
export interface ServeProjectFileEntry {
  /**
   * Its path below the project folder, with `/`.
   */
  path: string;
  /**
   * What it contains.
   */
  kind: FileKind;
  /**
   * Its size in bytes.
   */
  bytes: number;
}
/**
 * What the columns of a table are: of a file of the project, or of a text.
 */
export interface ServeReadingsColumnsRequest {
  /**
   * The file of the readings.
   */
  path?: string | null;
  /**
   * Their text instead.
   */
  text?: string | null;
  /**
   * What separates the columns; found if it is left out. A space stands for any number of them.
   */
  separator?: string | null;
  /**
   * The line of the headings, counted from 1; 0 where there are none; found if it is left out.
   */
  heading_line?: number | null;
  /**
   * The text of a mapping file; that beside the file of the readings if it is left out.
   */
  mapping?: string | null;
}
/**
 * A table as it stands in its file.
 */
export interface ServeReadingsColumns {
  /**
   * The table; null where no two columns were found.
   */
  table: ServeReadingsColumnsTableEntry | null;
  /**
   * The text of the mapping file; null if there is none.
   */
  mapping: string | null;
  /**
   * Whether it says more than what the columns of one table are, so that only its text can be edited.
   */
  is_mapping_text: boolean;
}
/**
 * Its layout.
 */
export interface ServeReadingsColumnsTableEntry {
  /**
   * What separates its columns.
   */
  separator: string;
  /**
   * The sign before decimals that the mapping file states.
   */
  decimal: string | null;
  /**
   * What the line after the last reading begins with, as the mapping file states it.
   */
  until: string | null;
  /**
   * The line of the headings, counted from 1; null where there are none.
   */
  heading_line: number | null;
  /**
   * The line of the headings, or of the first reading.
   */
  first_line: number;
  /**
   * Rows between headings and readings.
   */
  rows_below_headings: number;
  /**
   * Rows of readings.
   */
  readings: number;
  /**
   * Its columns.
   */
  columns: TableColumnEntry[];
}
/**
 * A column of it.
 */
export interface TableColumnEntry {
  /**
   * Its heading; empty where there is none.
   */
  heading: string;
  /**
   * What it is, by its heading or the mapping file; null if that is not known.
   */
  role: string | null;
  /**
   * Its unit; null if that is not known.
   */
  unit: string | null;
  /**
   * Whether its sign is changed.
   */
  negate: boolean;
  /**
   * Its first values.
   */
  values: string[];
  /**
   * Its words, each with what it means; null if that is not known.
   */
  words: [string, string | null][];
}
/**
 * The text of a file that was dropped, in any usual encoding.
 */
export interface ServeReadingsTextRequest {
  /**
   * Its bytes in base64.
   */
  base64: string;
  /**
   * Its encoding by a name of the WHATWG standard; found by its bytes if it is left out.
   */
  encoding?: string | null;
}
/**
 * The text of readings.
 */
export interface ServeReadingsText {
  /**
   * The text.
   */
  text: string;
  /**
   * The encoding by its name in the WHATWG standard.
   */
  encoding: string;
  /**
   * Whether nothing in the file proves that encoding.
   */
  is_assumed: boolean;
}
/**
 * The answer to a request by POST that is refused.
 */
export interface ServeRefused {
  /**
   * Why.
   */
  error: RefusalEntry;
}
/**
 * Why a request is not answered.
 */
export interface RefusalEntry {
  /**
   * The code, such as `bad-request`; `trueaxis explain CODE` has its meaning and its remedy.
   */
  code: string;
  /**
   * The reason in one sentence.
   */
  message: string;
  /**
   * What to do; may be empty.
   */
  hint: string;
  /**
   * The problems of the input, if that is the reason.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * Makes a report.
 */
export interface ServeReportRequest {
  /**
   * The command whose report it is.
   */
  verb: Verb;
  /**
   * The file that the command takes; a folder, for `history`.
   */
  file: string;
  /**
   * The machine file, for `simulate`; the older one, for `diff`.
   */
  machine?: string | null;
  /**
   * The standard, for `evaluate`.
   */
  standard?: string | null;
  /**
   * Tolerances such as `A=10 um`, for `evaluate`.
   */
  tolerances?: string[] | null;
  /**
   * Whether a value alone decides, without its uncertainty, for `evaluate`.
   */
  is_simple?: boolean | null;
  /**
   * The file of the conditions, for `evaluate`.
   */
  conditions?: string | null;
  /**
   * The radius of a circular test, for `evaluate`.
   */
  radius?: string | null;
  /**
   * The window of a drift test, for `evaluate`.
   */
  window?: string | null;
  /**
   * The feature of a QIF file, for `evaluate`.
   */
  feature?: string | null;
  /**
   * The control of the programs, for `plan`.
   */
  dialect?: string | null;
  /**
   * What else is asked, by the names of the requests `compensate-program`, `compensate-tables` and `compensate-adapt`.
   */
  options?: {
    [k: string]: unknown;
  } | null;
  /**
   * The file of its heading, to be filed and signed.
   */
  heading?: string | null;
  /**
   * Its language: `en`, `de` or `zh`; `en` where it is not stated.
   */
  language?: string | null;
}
/**
 * A report that was made.
 */
export interface ServeReport {
  /**
   * Its address on the server; only the last few reports are kept.
   */
  url: string;
  /**
   * Its size in bytes.
   */
  bytes: number;
  /**
   * A name for the file.
   */
  name: string;
  /**
   * The address of the same as PDF; null where this build writes none.
   */
  pdf: string | null;
  /**
   * What was found in the heading, and characters that no font has.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * Saves a file that an answer made, under its name or another one with the same ending. A file that is there is replaced
 * only if TrueAxis wrote it and it was not edited since.
 */
export interface ServeSaveMadeRequest {
  /**
   * The number of the files of the answer.
   */
  made: number;
  /**
   * Which of them, from 0.
   */
  file: number;
  /**
   * Its path below the project folder.
   */
  path: string;
  /**
   * The window that saves it.
   */
  window?: string | null;
}
/**
 * A file that was saved.
 */
export interface ServeSaveMade {
  /**
   * Its path.
   */
  path: string;
  /**
   * The version of its new text.
   */
  version: string;
}
/**
 * Replaces the text of a file, if it is still the one that was opened.
 */
export interface ServeSaveRequest {
  /**
   * Its path below the project folder: TOML or CSV.
   */
  path: string;
  /**
   * The new text.
   */
  text: string;
  /**
   * The version that was opened; null for a new file.
   */
  version?: string | null;
  /**
   * Whether its folder is made where it is missing.
   */
  make_folder?: boolean | null;
  /**
   * The window that saves it, so that it recognises its own changes.
   */
  window?: string | null;
}
/**
 * A file that was saved.
 */
export interface ServeSave {
  /**
   * Its path.
   */
  path: string;
  /**
   * The version of its new text.
   */
  version: string;
}
/**
 * The text of the machine file with one error in it; nothing is saved.
 */
export interface ServeSetErrorRequest {
  /**
   * The machine file.
   */
  machine: string;
  /**
   * Its present text.
   */
  text: string;
  /**
   * The ISO 230-1 name of the error.
   */
  error: string;
  /**
   * The error as it is written in the file; empty to remove it.
   */
  value: string;
}
/**
 * The machine file with the error.
 */
export interface ServeSetError {
  /**
   * Its new text.
   */
  text: string;
  /**
   * The problems of the new text.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * Simulates a program: a file of the project, or `name` and `text` of one that was dropped.
 */
export interface ServeSimulateRequest {
  /**
   * The machine file.
   */
  machine: string;
  /**
   * The program.
   */
  program?: string | null;
  /**
   * The set-up file; the one beside the program if it is left out.
   */
  setup?: string | null;
  /**
   * The control that the program is for, as `--control` of the command line.
   */
  control?: string | null;
  /**
   * The name of a program that was dropped.
   */
  name?: string | null;
  /**
   * Its text.
   */
  text?: string | null;
  /**
   * Whether the simulation goes on after errors; false if it is left out.
   */
  keep_going?: boolean | null;
  /**
   * Whether collisions are looked for; true if it is left out.
   */
  collisions?: boolean | null;
  /**
   * Whether blocks with `/` are executed, as with the switch of the control off; true if it is left out.
   */
  optional_blocks?: boolean | null;
}
/**
 * A simulation. Array: `corners_mm` (f32: the corners of the triangles of `on_workpiece`, nine numbers each).
 */
export interface ServeSimulate {
  /**
   * How long the program runs, s.
   */
  duration_s: number;
  /**
   * How many nodes the path has.
   */
  nodes: number;
  /**
   * How many of them are kept.
   */
  kept: number;
  /**
   * Whether some are not kept.
   */
  thinned: boolean;
  /**
   * The axes.
   */
  axes: SimulatedAxisEntry[];
  /**
   * The quantities that can be shown as curves.
   */
  quantities: ServeSimulateQuantityEntry[];
  /**
   * The programs that ran, the main program first.
   */
  programs: ServeSimulateProgramEntry[];
  /**
   * The issues in the order of time.
   */
  marks: MarkEntry[];
  /**
   * The names of the bodies of the machine.
   */
  bodies: string[];
  /**
   * The document of `trueaxis simulate`.
   */
  document: SimulationDocument;
  /**
   * The tools of the set-up.
   */
  tools: SetUpToolEntry[];
  /**
   * Stock, part and fixtures of the set-up.
   */
  on_workpiece: SurfaceEntry[];
  /**
   * The problems of machine, set-up and program.
   */
  diagnostics: DiagnosticEntry[];
  /**
   * The number of the simulation, for further requests; only the last few are kept.
   */
  simulation: number;
}
/**
 * An axis of the simulated machine.
 */
export interface SimulatedAxisEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * The unit of its positions.
   */
  unit: "mm" | "deg";
  /**
   * Its travel in that unit; null if it has no limits.
   *
   * @minItems 2
   * @maxItems 2
   */
  travel: [number, number] | null;
  /**
   * Its maximum velocity, mm/s or deg/s; null if it is not stated.
   */
  velocity: number | null;
  /**
   * Its maximum acceleration, mm/s² or deg/s²; null if it is not stated.
   */
  acceleration: number | null;
}
/**
 * A quantity that can be shown as a curve.
 */
export interface ServeSimulateQuantityEntry {
  /**
   * Its name in requests, such as `X`, `X.speed`, `tip`.
   */
  key: string;
  /**
   * Its title.
   */
  title: string;
  /**
   * Its unit.
   */
  unit: string;
  /**
   * Its limits, from and to; null if it has none.
   *
   * @minItems 2
   * @maxItems 2
   */
  limits: [number, number] | null;
}
/**
 * A program that ran.
 */
export interface ServeSimulateProgramEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its path below the project folder; null if it is not a file there.
   */
  path: string | null;
  /**
   * How many lines it has.
   */
  lines: number;
}
/**
 * An issue of the simulation.
 */
export interface MarkEntry {
  /**
   * Its kind, such as `collision`.
   */
  kind: string;
  /**
   * Whether part or machine are in danger.
   */
  grave: boolean;
  /**
   * When it begins, s.
   */
  time_s: number;
  /**
   * When it ends, s; null if it is a moment.
   */
  until_s: number | null;
  /**
   * The issue in one sentence.
   */
  text: string;
  /**
   * The number of the program where it begins.
   */
  program: number;
  /**
   * The line there, from 1.
   */
  line: number;
  /**
   * How many stretches it holds: above 1 where the nearest of many were put together.
   */
  stretches: number;
}
/**
 * A simulation of a program on a machine: `trueaxis/simulate/1`.
 */
export interface SimulationDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/simulate/1";
  /**
   * The version of the program `trueaxis`.
   */
  version: string;
  /**
   * The machine.
   */
  machine: ServeSimulateMachineEntry;
  /**
   * The program file.
   */
  program: string;
  /**
   * The program and its subprograms; `program` elsewhere is an index into this list.
   */
  programs: string[];
  /**
   * The control.
   */
  control: string;
  /**
   * Whether a set-up was given; without one work offsets and tool lengths are 0.
   */
  set_up_given: boolean;
  /**
   * The result.
   */
  verdict: Verdict;
  /**
   * The whole time, s.
   */
  time_s: number;
  /**
   * Time of rapid moves, s.
   */
  rapid_s: number;
  /**
   * Time of dwells, s.
   */
  dwell_s: number;
  /**
   * Path length of the tool tip in the workpiece with feed, mm.
   */
  feed_mm: number;
  /**
   * The same of rapid moves, mm.
   */
  rapid_mm: number;
  /**
   * How many moves the program makes.
   */
  moves: number;
  /**
   * How many points of the path were computed.
   */
  nodes: number;
  /**
   * Smallest and largest coordinates of the nominal tool tip with feed, workpiece frame, mm; null if it never
   * moves with feed.
   *
   * @minItems 2
   * @maxItems 2
   */
  tip_box_mm: [[number, number, number], [number, number, number]] | null;
  /**
   * Every axis by its name, in chain order.
   */
  axes: {
    [k: string]: ServeSimulateAxisEntry;
  };
  /**
   * The largest deviations of the actual tool from the nominal one.
   */
  deviation: ServeSimulateDeviationEntry;
  /**
   * The first 1000 reversals of all axes, in order of time.
   */
  reversals: ReversalEntry[];
  /**
   * The issues that were found.
   */
  troubles: IssueEntry[];
  /**
   * How many stretches of issues there are in all: the sum of `stretches`.
   */
  troubles_found: number;
  /**
   * How many functions of the program that move the tool or its place are not executed: they are among the
   * diagnostics.
   */
  motion_left_out: number;
  /**
   * How many times the program asks for a speed of the spindle or a tool that the machine does not have: they are
   * among the diagnostics.
   */
  beyond_equipment: number;
  /**
   * Messages of the program to the operator.
   */
  messages: string[];
  /**
   * Stops in the program, optional ones not counted.
   */
  stops: number;
  /**
   * The tools in the order of their numbers.
   */
  tools: ToolEntry[];
  /**
   * The file that the path was written to; null if none was asked for.
   */
  path_file: string | null;
  /**
   * Temperatures during the program; null without a temperature log.
   */
  temperatures: TemperaturesEntry | null;
  /**
   * What became of the stock; null where it was not cut (`--stock`).
   */
  stock: StockEntry | null;
}
/**
 * The machine.
 */
export interface ServeSimulateMachineEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its kinematic chain from workpiece to tool.
   */
  chain: string;
}
/**
 * The motion of one axis.
 */
export interface ServeSimulateAxisEntry {
  /**
   * Its unit: `mm` or `deg`.
   */
  unit: string;
  /**
   * The lowest position; null if the axis does not move. Unit: that of `unit`.
   */
  lowest: number | null;
  /**
   * The highest position; null if the axis does not move. Unit: that of `unit`.
   */
  highest: number | null;
  /**
   * The distance that it travels. Unit: that of `unit`.
   */
  travelled: number | null;
  /**
   * How often it changes its direction.
   */
  reversals: number;
  /**
   * Its highest speed, in its unit per second.
   */
  fastest_per_s: number | null;
  /**
   * The line of the program where that is.
   */
  fastest_line: number;
  /**
   * Its speed limit, in its unit per second; null if the machine file states none.
   */
  velocity_limit_per_s: number | null;
}
/**
 * The largest deviations of the actual tool from the nominal one, in the workpiece. Those along feed, normal and
 * binormal have a sign; the others are lengths.
 */
export interface ServeSimulateDeviationEntry {
  /**
   * Tool tip with feed, µm.
   */
  tip_um: ServeSimulateWorstEntry;
  /**
   * Root mean square of the tool tip over all points with feed, µm.
   */
  tip_rms_um: number;
  /**
   * Tool tip along the feed, µm.
   */
  feed_um: ServeSimulateWorstEntry;
  /**
   * Tool tip along the normal: across the feed, on the side of the tool axis, µm.
   */
  normal_um: ServeSimulateWorstEntry;
  /**
   * Tool tip along the binormal: across feed and normal, µm.
   */
  binormal_um: ServeSimulateWorstEntry;
  /**
   * Tool axis with feed, µrad.
   */
  axis_urad: ServeSimulateWorstEntry;
  /**
   * Tool tip, rapid moves included, µm.
   */
  tip_with_rapid_um: ServeSimulateWorstEntry;
  /**
   * Tool axis, rapid moves included, µrad.
   */
  axis_with_rapid_urad: ServeSimulateWorstEntry;
}
/**
 * A largest value and where it occurs.
 */
export interface ServeSimulateWorstEntry {
  /**
   * The value. Unit: that of the key.
   */
  value: number;
  /**
   * The line.
   */
  line: number;
  /**
   * The program, an index into `programs`.
   */
  program: number;
  /**
   * The time, s.
   */
  time_s: number;
}
/**
 * A reversal of an axis.
 */
export interface ReversalEntry {
  /**
   * The axis.
   */
  axis: string;
  /**
   * Its position. Unit: mm or deg.
   */
  at: number;
  /**
   * The line.
   */
  line: number;
  /**
   * The program, an index into `programs`.
   */
  program: number;
  /**
   * The time, s.
   */
  time_s: number;
}
/**
 * A tool.
 */
export interface ToolEntry {
  /**
   * Its number.
   */
  tool: number;
  /**
   * How many moves it makes.
   */
  moves: number;
  /**
   * How long it moves with feed, s.
   */
  with_feed_s: number;
  /**
   * How far its tip moves with feed in the workpiece, mm.
   */
  with_feed_mm: number;
  /**
   * What is known of its wear and its life; null if the set-up states nothing.
   */
  state: ToolStateEntry | null;
}
/**
 * The state of a tool.
 */
export interface ToolStateEntry {
  /**
   * In one or two words: `fit`, `not decided`, `worn`, `broken` or `life spent`.
   */
  word: string;
  /**
   * Measured − nominal length, µm; null if it was not measured.
   */
  length_off_um: number | null;
  /**
   * Its expanded uncertainty (k = 2), µm.
   */
  U_length_um: number | null;
  /**
   * Measured − nominal radius, µm; null if it was not measured.
   */
  radius_off_um: number | null;
  /**
   * Its expanded uncertainty (k = 2), µm.
   */
  U_radius_um: number | null;
  /**
   * The life that remains after this program, s; null if it does not count by time.
   */
  life_after_s: number | null;
  /**
   * The life that remains after this program, mm; null if it does not count by distance.
   */
  life_after_mm: number | null;
  /**
   * The tool that takes its place.
   */
  sister: number | null;
}
/**
 * Temperatures during the program, and the drift that they cause.
 */
export interface TemperaturesEntry {
  /**
   * The file of the log.
   */
  log: string;
  /**
   * The time of the log when the program begins, s.
   */
  from_s: number;
  /**
   * The time of the log when the program ends, s.
   */
  to_s: number;
  /**
   * Every sensor by its name.
   */
  sensors: {
    [k: string]: SimulateSensorEntry;
  };
  /**
   * How far the deviation of the tool tip has moved since the start, with feed: the largest value, µm.
   */
  drift_um: SimulateWorstEntry;
  /**
   * The same at the end, µm.
   */
  drift_at_end_um: number;
  /**
   * How many points of the path have no known drift, because an error table ends before them.
   */
  drift_unknown_places: number;
}
/**
 * The range of a temperature sensor.
 */
export interface SimulateSensorEntry {
  /**
   * The lowest temperature; null without a reading. Unit: °C.
   */
  lowest_degC: number | null;
  /**
   * The highest temperature; null without a reading. Unit: °C.
   */
  highest_degC: number | null;
}
/**
 * A largest value and where it occurs.
 */
export interface SimulateWorstEntry {
  /**
   * The value. Unit: that of the key.
   */
  value: number;
  /**
   * The line.
   */
  line: number;
  /**
   * The program, an index into `programs`.
   */
  program: number;
  /**
   * The time, s.
   */
  time_s: number;
}
/**
 * What became of the stock.
 */
export interface StockEntry {
  /**
   * Distance of the lines that the stock is kept on, mm.
   */
  resolution_mm: number;
  /**
   * Volume before the first cut, mm³.
   */
  before_mm3: number;
  /**
   * Volume that remains, mm³.
   */
  left_mm3: number;
  /**
   * How far the volumes by lines along X, Y and Z differ from their mean, mm³.
   */
  spread_mm3: number;
  /**
   * Volume that was removed, mm³.
   */
  removed_mm3: number;
  /**
   * With feed in material, s.
   */
  cutting_s: number;
  /**
   * With feed in the air, s.
   */
  air_s: number;
  /**
   * Volume that was cut from the part of the set-up, mm³; null without a part.
   */
  gouged_mm3: number | null;
  /**
   * Volume that remains beside the part, mm³; null without a part.
   */
  excess_mm3: number | null;
  /**
   * The first 1000 blocks that move a tool, in the order of programs and lines.
   */
  blocks: SimulateBlockEntry[];
  /**
   * How many more there are.
   */
  blocks_left_out: number;
}
/**
 * What a block took, all its runs together.
 */
export interface SimulateBlockEntry {
  /**
   * The program, an index into `programs`.
   */
  program: number;
  /**
   * The line.
   */
  line: number;
  /**
   * Volume that it removed, mm³.
   */
  removed_mm3: number;
  /**
   * With feed in material, s.
   */
  cutting_s: number;
  /**
   * With feed in the air, s.
   */
  air_s: number;
}
/**
 * A tool of the set-up.
 */
export interface SetUpToolEntry {
  /**
   * Its number.
   */
  tool: number;
  /**
   * Its name.
   */
  name: string;
  /**
   * Its tip in the frame of the tool holder, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_mm: [number, number, number];
  /**
   * Diameter and length of each of its cylinders from the tip upwards, mm; empty if they are not stated.
   */
  segments_mm: [number, number][];
}
/**
 * Everything at one time.
 */
export interface ServeSimulationAtRequest {
  /**
   * The number of the simulation.
   */
  simulation: number;
  /**
   * The time, s.
   */
  time_s: number;
}
/**
 * A moment. Arrays: `nominal`, `actual` (f64: for each body its rotation row by row, then its origin, mm, in the
 * machine frame).
 */
export interface ServeSimulationAt {
  /**
   * Program, axes and tool.
   */
  moment: MomentEntry;
}
/**
 * Program, axes and tool at one time.
 */
export interface MomentEntry {
  /**
   * The time from the start of the program, s.
   */
  time_s: number;
  /**
   * The number of the program.
   */
  program: number;
  /**
   * Its line, from 1.
   */
  line: number;
  /**
   * The positions of the axes by name, mm or degrees.
   */
  axes: {
    [k: string]: number;
  };
  /**
   * The direction of the last motion of each axis: +1, −1, or 0 before the first.
   */
  approach: {
    [k: string]: number;
  };
  /**
   * The nominal tip in the workpiece frame, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_mm: [number, number, number];
  /**
   * The deviation of the tip, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  off_tip_um: [number, number, number];
  /**
   * The deviation of the tool axis, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  off_axis_urad: [number, number, number];
  /**
   * The deviation of the tip along feed, normal and binormal, µm; null where the path has no direction.
   *
   * @minItems 3
   * @maxItems 3
   */
  along_path_um: [number | null, number | null, number | null];
  /**
   * The speed along the path, mm/min.
   */
  speed_mm_per_min: number;
  /**
   * Whether the axes move in rapid traverse.
   */
  rapid: boolean;
  /**
   * Whether the axes wait.
   */
  waits: boolean;
  /**
   * The number of the tool in the spindle; null if there is none.
   */
  tool: number | null;
}
/**
 * When a block ends: the one after or before a time (`step`, `from_s`), or that of a line (`program`, `line`).
 */
export interface ServeSimulationBlockRequest {
  /**
   * The number of the simulation.
   */
  simulation: number;
  /**
   * Which block from `from_s`.
   */
  step?: BlockStep | null;
  /**
   * The time, s.
   */
  from_s?: number | null;
  /**
   * The number of the program.
   */
  program?: number | null;
  /**
   * The line, from 1.
   */
  line?: number | null;
}
/**
 * The end of a block.
 */
export interface ServeSimulationBlock {
  /**
   * When it ends, s.
   */
  time_s: number;
}
/**
 * Curves over a range of time.
 */
export interface ServeSimulationCurvesRequest {
  /**
   * The number of the simulation.
   */
  simulation: number;
  /**
   * From this time, s.
   */
  from_s: number;
  /**
   * To this time, s.
   */
  to_s: number;
  /**
   * How many columns of equal time.
   */
  columns: number;
  /**
   * The names of the quantities.
   */
  quantities: string[];
}
/**
 * Curves. Arrays: `low`, `high` (f32: the extent in each column, quantity after quantity).
 */
export interface ServeSimulationCurves {
  /**
   * From this time, s.
   */
  from_s: number;
  /**
   * To this time, s.
   */
  to_s: number;
  /**
   * How many columns of equal time.
   */
  columns: number;
  /**
   * The names of the quantities, in the order of the arrays.
   */
  quantities: string[];
}
/**
 * The path of the tip.
 */
export interface ServeSimulationPathRequest {
  /**
   * The number of the simulation.
   */
  simulation: number;
  /**
   * From this time, s; from the start if it is left out.
   */
  from_s?: number | null;
  /**
   * To this time, s; to the end if it is left out.
   */
  to_s?: number | null;
  /**
   * At most so many points.
   */
  points: number;
  /**
   * The quantity that colours the path.
   */
  colour: PathColour;
}
/**
 * A path. Arrays, for each point: `tip_mm` (f32: three, from `origin_mm`), `off_um` (f32: three), `value` (f32),
 * `rapid` (u8: 1 in rapid traverse), `time_s` (f64), `program`, `line` (u32).
 */
export interface ServeSimulationPath {
  /**
   * The origin of the points in the workpiece frame, mm.
   *
   * @minItems 3
   * @maxItems 3
   */
  origin_mm: [number, number, number];
  /**
   * The unit of the values.
   */
  unit: string;
  /**
   * The title of the values.
   */
  title: string;
  /**
   * The lowest value.
   */
  low: number;
  /**
   * The highest value.
   */
  high: number;
  /**
   * How far the drawn path is from the simulated one, mm.
   */
  chord_mm: number;
  /**
   * Whether all points of the simulation are drawn.
   */
  complete: boolean;
}
/**
 * The text of a program as it was simulated.
 */
export interface ServeSimulationSourceRequest {
  /**
   * The number of the simulation.
   */
  simulation: number;
  /**
   * The number of the program.
   */
  program: number;
}
/**
 * A program.
 */
export interface ServeSimulationSource {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its text.
   */
  text: string;
}
/**
 * The stock as it is at one time.
 */
export interface ServeSimulationStockRequest {
  /**
   * The number of the simulation.
   */
  simulation: number;
  /**
   * The time, s.
   */
  time_s: number;
}
/**
 * The stock at a time. Array: `corners_mm` (f32: the corners of the triangles of `on_workpiece`, nine numbers each).
 */
export interface ServeSimulationStock {
  /**
   * The time, s.
   */
  time_s: number;
  /**
   * What remains of the stock, mm³.
   */
  left_mm3: number;
  /**
   * What was removed, mm³.
   */
  removed_mm3: number;
  /**
   * Stock, part and fixtures of the set-up.
   */
  on_workpiece: SurfaceEntry[];
}
/**
 * What a window sends: a request, or that it no longer waits for one.
 */
export interface ServeSocketRequest {
  /**
   * The number of the request, chosen by the page; its answers have the same.
   */
  id: number;
  /**
   * The name of the request, such as `pose`.
   */
  ask?: string | null;
  /**
   * The request.
   */
  body?: {
    [k: string]: unknown;
  };
  /**
   * True if the answer is not awaited any more.
   */
  stop?: boolean | null;
}
/**
 * A change of a file; without a path any file may have changed.
 */
export interface ChangeEntry {
  /**
   * Its path below the project folder.
   */
  path?: string | null;
  /**
   * The version of its new text.
   */
  version?: string | null;
  /**
   * The window that saved it; absent if that is not known.
   */
  window?: string | null;
}
/**
 * The standards.
 */
export interface ServeStandardsRequest {}
/**
 * A standard.
 */
export interface StandardEntry {
  /**
   * Its name in requests and on the command line.
   */
  key: string;
  /**
   * Its title.
   */
  title: string;
  /**
   * The columns that its table may have.
   */
  columns: ColumnEntry[];
}
/**
 * A column that a table of readings may have.
 */
export interface ColumnEntry {
  /**
   * Its name in a mapping file.
   */
  name: string;
  /**
   * What it holds.
   */
  title: string;
  /**
   * Its usual units; none where it has no unit.
   */
  units: string[];
  /**
   * Whether several of them are numbered: `up_1`, `up_2`.
   */
  is_numbered: boolean;
  /**
   * What its words mean; none where it has numbers or any words.
   */
  words: string[];
}
/**
 * One line of a program, as `trueaxis trace` shows its block.
 */
export interface ServeTraceRequest {
  /**
   * The machine file.
   */
  machine: string;
  /**
   * The program.
   */
  program?: string | null;
  /**
   * The set-up file; the one beside the program if it is left out.
   */
  setup?: string | null;
  /**
   * The control that the program is for, as `--control` of the command line.
   */
  control?: string | null;
  /**
   * The name of a program that was dropped.
   */
  name?: string | null;
  /**
   * Its text.
   */
  text?: string | null;
  /**
   * Whether blocks with `/` are executed, as with the switch of the control off; true if it is left out.
   */
  optional_blocks?: boolean | null;
  /**
   * The line of the block, from 1.
   */
  line: number;
}
/**
 * A document of the command line with the problems of its input.
 */
export interface ServeTrace {
  /**
   * Which document this is.
   */
  schema: "trueaxis/trace/1";
  /**
   * The machine.
   */
  machine: MachineEntry;
  /**
   * The file of the program.
   */
  program: string;
  /**
   * The block that was asked for: its number N, else its line.
   */
  block: number;
  /**
   * Its line in the program.
   */
  line: number;
  /**
   * Its text.
   */
  text: string;
  /**
   * How often it is executed; the first time is traced.
   */
  executions: number;
  /**
   * What the interpreter of the control makes of it.
   */
  programmed: ProgrammedEntry;
  /**
   * The points into which its path is divided.
   */
  nodes: NodeEntry[];
  /**
   * The positions of the axes, mm and degrees.
   */
  axes?: {
    [k: string]: number;
  };
  /**
   * The nominal tool in the workpiece frame.
   */
  nominal?: ToolPoseEntry;
  /**
   * The actual tool there.
   */
  actual?: ToolPoseEntry;
  /**
   * Actual − nominal.
   */
  deviation?: PathDeviationEntry;
  /**
   * When the block runs.
   */
  time?: TimeEntry;
  /**
   * The deviation at its end under each error alone; absent if nothing moves.
   */
  budget?: ShareEntry[] | null;
  /**
   * The place of every body at its end; absent if nothing moves.
   */
  bodies?: BodyEntry[] | null;
  /**
   * The problems found in the input.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A block as the control reads it.
 */
export interface ProgrammedEntry {
  /**
   * Its moves.
   */
  moves: MoveEntry[];
  /**
   * What else it does, in words.
   */
  events: string[];
  /**
   * The program frame.
   */
  frame: TraceFrameEntry;
  /**
   * Whether the tip of the tool is programmed (RTCP, TRAORI, TCPM).
   */
  tool_centre: boolean;
  /**
   * Whether the frame is that of a tilted working plane.
   */
  tilted_plane: boolean;
  /**
   * How the tool axis is interpolated: `axes`, `great circle` or `cone`.
   */
  orientation: string;
  /**
   * The number of the tool in the spindle.
   */
  tool: number;
  /**
   * The tool length that is in effect, mm along X, Y and Z.
   */
  tool_length_mm: number[];
}
/**
 * A move as it is programmed.
 */
export interface MoveEntry {
  /**
   * `rapid`, `line`, `circle`, `thread` and so on.
   */
  kind: string;
  /**
   * The position of the axes that are named, mm and degrees, in the program frame.
   */
  target: {
    [k: string]: number;
  };
  /**
   * The tool axis if it is programmed as a vector. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  direction: [number, number, number] | null;
  /**
   * The feed with its unit, or `rapid`.
   */
  feed: string;
}
/**
 * A program frame.
 */
export interface TraceFrameEntry {
  /**
   * Rotation, scale and mirror of X, Y and Z, row by row. Unit: 1.
   *
   * @minItems 3
   * @maxItems 3
   */
  linear: [[number, number, number], [number, number, number], [number, number, number]];
  /**
   * Its origin: X Y Z A B C U V W, mm and degrees. Unit: mm or deg.
   *
   * @minItems 9
   * @maxItems 9
   */
  shift: [number, number, number, number, number, number, number, number, number];
}
/**
 * A point of the path.
 */
export interface NodeEntry {
  /**
   * The nominal tool in the workpiece frame.
   */
  nominal: ToolPoseEntry;
  /**
   * The actual tool there.
   */
  actual: ToolPoseEntry;
  /**
   * Actual − nominal.
   */
  deviation: PathDeviationEntry;
  /**
   * The positions of the axes, mm and degrees.
   */
  axes: {
    [k: string]: number;
  };
  /**
   * The time since the start of the program, s.
   */
  time_s: number;
}
/**
 * A deviation of the tool on its path.
 */
export interface PathDeviationEntry {
  /**
   * Of the tip, µm.
   *
   * @minItems 3
   * @maxItems 3
   */
  tip_um: [number, number, number];
  /**
   * Of the axis, µrad.
   *
   * @minItems 3
   * @maxItems 3
   */
  axis_urad: [number, number, number];
  /**
   * Of the tip along the feed, µm.
   */
  feed_um: number;
  /**
   * Of the tip along the principal normal of the path, µm.
   */
  normal_um: number;
  /**
   * Of the tip along the binormal of the path, µm.
   */
  binormal_um: number;
}
/**
 * When a block runs.
 */
export interface TimeEntry {
  /**
   * Its start, s since the start of the program.
   */
  from_s: number;
  /**
   * Its end, s.
   */
  to_s: number;
  /**
   * The speed of the tip at its end, mm/min.
   */
  speed_mm_per_min: number;
}
/**
 * Verifies.
 */
export interface ServeVerifyRequest {
  /**
   * What is asked.
   */
  what: VerifiedSubject;
  /**
   * The file that `what` takes; the older machine file of `diff`, a folder or a file of `history`.
   */
  file: string;
  /**
   * The newer machine file of `diff`.
   */
  new?: string | null;
  /**
   * Limits of figures of `history`, as `--limit` of the command line: `EC0X=40 urad`.
   */
  limits?: string[] | null;
}
/**
 * What was verified.
 */
export interface ServeVerify {
  /**
   * The document of `trueaxis verify`.
   */
  document: VerifiedDocument;
  /**
   * Its report.
   */
  shown: ShownEntry;
  /**
   * The problems of the input.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * Readings compared with a prediction, or with other readings.
 */
export interface VerifyDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/verify/1";
  /**
   * The name of the comparison.
   */
  name: string;
  /**
   * What the readings are compared with: `prediction` or `readings`.
   */
  against: string;
  /**
   * How many readings.
   */
  readings: number;
  /**
   * The coverage factor k of U = k·u. Unit: 1.
   */
  coverage_factor: number;
  /**
   * The decision rule in words.
   */
  rule: string;
  /**
   * `pass`, `fail` or `undecided`.
   */
  verdict: string;
  /**
   * How many numbers pass.
   */
  pass: number;
  /**
   * How many fail.
   */
  fail: number;
  /**
   * How many are neither.
   */
  undecided: number;
  /**
   * The share of all numbers within U.
   */
  coverage: CoverageEntry;
  /**
   * By instrument.
   */
  instruments: PartEntry[];
  /**
   * By place, the worst first.
   */
  places: PlacePartEntry[];
  /**
   * What the readings make of what is stated of the set-up with an uncertainty.
   */
  set_up: SetUpEntry[];
  /**
   * Every number.
   */
  deviations: DifferenceEntry[];
}
/**
 * A share of numbers within U.
 */
export interface CoverageEntry {
  /**
   * How many numbers.
   */
  numbers: number;
  /**
   * How many of them are within U.
   */
  inside: number;
  /**
   * The number of independent ones: errors of the machine shift many readings at once. Unit: 1.
   */
  independent: number;
  /**
   * `inside` over `numbers`. Unit: 1.
   */
  share: number;
  /**
   * The 95 % interval of the share (Wilson). Unit: 1.
   *
   * @minItems 2
   * @maxItems 2
   */
  interval_95: [number, number];
  /**
   * The share that is expected. Unit: 1.
   */
  expected: number;
}
/**
 * The numbers of an instrument or a place. Its root mean squares are `rms_nominal_um` (nominal machine; null
 * against readings) and `rms_um` (machine file, or between the two sets of readings), µm; `…_urad`, µrad, of an
 * instrument that measures angles.
 */
export interface PartEntry {
  /**
   * The name of the instrument.
   */
  instrument: string;
  /**
   * The share within U.
   */
  coverage: CoverageEntry;
  /**
   * The largest |deviation| / U; null where U is 0. Unit: 1.
   */
  largest_ratio: number | null;
  [k: string]: number | null;
}
/**
 * The numbers of a place.
 */
export interface PlacePartEntry {
  /**
   * The name of the instrument.
   */
  instrument: string;
  /**
   * The share within U.
   */
  coverage: CoverageEntry;
  /**
   * The largest |deviation| / U; null where U is 0. Unit: 1.
   */
  largest_ratio: number | null;
  /**
   * The number of the place.
   */
  group: number;
  /**
   * A line of the readings there.
   */
  line: number;
  [k: string]: number | null;
}
/**
 * An unknown of the set-up: `deviation_um`, fitted − stated, and `u_um`, its standard uncertainty where machine file and statement are
 * right; `…_urad`, `…_um_per_m`, `…_um_per_h` or `…_urad_per_h` by the kind of the unknown.
 */
export interface SetUpEntry {
  /**
   * The name of the instrument.
   */
  instrument: string;
  /**
   * The unknown.
   */
  unknown: string;
  /**
   * Whether the readings contradict machine file and statement together: the verdict is `fail` then.
   */
  is_contradicted: boolean;
  [k: string]: number;
}
/**
 * One number: `deviation_um`, measured − expected, and `expanded_um`, its U, in µm; `…_urad` in µrad.
 */
export interface DifferenceEntry {
  /**
   * The name of the instrument.
   */
  instrument: string;
  /**
   * The line of its reading.
   */
  line: number;
  /**
   * The channel of the instrument, from 0.
   */
  channel: number;
  [k: string]: number;
}
/**
 * Two calibrations of one machine: which errors have changed.
 */
export interface DiffDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/diff/1";
  /**
   * The version of TrueAxis.
   */
  version: string;
  /**
   * The name of the newer machine.
   */
  machine: string;
  /**
   * Its kinematic chain from the workpiece to the tool.
   */
  chain: string;
  /**
   * The older file.
   */
  old: string;
  /**
   * The newer file.
   */
  new: string;
  /**
   * The names of the errors that have changed significantly.
   */
  moved: string[];
  /**
   * The bound of the change of one error in its standard uncertainty, so that among all errors none is
   * above it by chance with 95 %. Unit: 1.
   */
  limit_u: number;
  /**
   * All errors.
   */
  errors: ErrorChangeEntry[];
  /**
   * What the changes do to the tip.
   */
  tip: TipChangeEntry;
  /**
   * The tables that hold at two temperatures.
   */
  temperatures: TwoTemperaturesEntry[];
}
/**
 * Figures of one machine over its calibrations: `trueaxis/history/1`.
 */
export interface HistoryDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/history/1";
  /**
   * The version of the program.
   */
  version: string;
  /**
   * The machine.
   */
  machine: string;
  /**
   * Whether nothing needs attention: no jump, no point outside of the control limits, no limit exceeded.
   */
  quiet: boolean;
  /**
   * Every figure with at least two dates.
   */
  series: SeriesEntry[];
  /**
   * Figures with one date only.
   */
  single: string[];
}
/**
 * The certificate of a volumetric compensation.
 */
export interface CertificateDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/certificate/1";
  /**
   * The version of TrueAxis.
   */
  version: string;
  /**
   * The name of the study.
   */
  name: string;
  /**
   * `pass`, `fail` or `undecided`.
   */
  verdict: string;
  /**
   * The reason in one sentence.
   */
  reason: string;
  /**
   * Number, customer, place, instruments with their certificates; null where they are not stated.
   */
  certificate: CertificateHead | null;
  /**
   * The machine.
   */
  machine: MachineEntry;
  /**
   * Its identified errors.
   */
  errors: CertifiedErrorEntry[];
  /**
   * How they were determined.
   */
  determination: DeterminationEntry;
  /**
   * How they are compensated.
   */
  compensation: CompensationEntry;
  /**
   * How the compensation was put into the control.
   */
  application: ApplicationEntry;
  /**
   * The measurement with the compensation in effect, at poses that the determination did not use.
   */
  validation: ValidationEntry;
  /**
   * The prediction for the zone in which the certificate holds.
   */
  zone: ZoneEntry;
  /**
   * The decision.
   */
  decision: DecisionEntry;
  /**
   * Every file that was read.
   */
  inputs: FileEntry[];
}
/**
 * Virtual lasers before and after compensation.
 */
export interface BeforeAfterDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/before-after/1";
  /**
   * Name of the campaign.
   */
  name: string;
  /**
   * Name of the machine file.
   */
  machine: string;
  /**
   * Name of the machine that was measured.
   */
  measured: string;
  /**
   * Seed of the random numbers; each compensation has the next one.
   */
  seed: number;
  /**
   * `values`, or `tables` of a control.
   */
  added_by: string;
  /**
   * The least increment of a value of a linear axis, µm.
   */
  increment_um: number;
  /**
   * The lasers.
   */
  lasers: LaserEntry[];
  /**
   * The readings, axis by axis.
   */
  curves: CurveEntry[];
  /**
   * The files that were written.
   */
  files: string[];
}
/**
 * Measured test pieces against their tolerances and their prediction.
 */
export interface VerifyPartDocument {
  /**
   * Which document this is.
   */
  schema: "trueaxis/verify-part/1";
  /**
   * The name of the file.
   */
  name: string;
  /**
   * The test piece.
   */
  test_piece: string;
  /**
   * What the prediction is.
   */
  prediction: string;
  /**
   * How many parts were measured.
   */
  parts: number;
  /**
   * The coverage factor k of U = k·u. Unit: 1.
   */
  coverage_factor: number;
  /**
   * The decision rule in words.
   */
  rule: string;
  /**
   * `pass`, `fail` or `undecided`: the parts against their tolerances.
   */
  verdict: string;
  /**
   * Why, in a sentence.
   */
  reason: string;
  /**
   * Whether the parts were measured in the frame of the best fit.
   */
  best_fit: boolean;
  /**
   * Index after index.
   */
  indices: PartIndexEntry[];
  /**
   * The circles of every section of every part that was measured by points.
   */
  sections: PartSectionEntry[];
  /**
   * What the reader of the numbers should know.
   */
  warnings: string[];
}
/**
 * One index.
 */
export interface PartIndexEntry {
  /**
   * Its key.
   */
  index: string;
  /**
   * Whether it decides.
   */
  decisive: boolean;
  /**
   * The predicted value, mm.
   */
  predicted_mm: number | null;
  /**
   * Its standard uncertainty, mm; null if not stated.
   */
  u_predicted_mm: number | null;
  /**
   * What the noise of the points adds to the predicted index on average, mm; 0 if not known.
   */
  noise_mm: number;
  /**
   * Part after part, mm.
   */
  measured_mm: number[];
  /**
   * Their standard uncertainties, mm; null if not stated.
   */
  u_measured_mm: number[] | null;
  /**
   * Mean of the parts, mm.
   */
  mean_mm: number | null;
  /**
   * Its standard uncertainty with the spread of the parts, mm.
   */
  u_mean_mm: number | null;
  /**
   * Predicted over measured mean (Fig 20 of Wu et al. 2022), %.
   */
  ratio_percent: number | null;
  /**
   * The same with the mean that the sheet prints, %; null if it prints none.
   */
  printed_ratio_percent: number | null;
  /**
   * |measured mean − predicted| over its expanded uncertainty; null where that is 0. Unit: 1.
   */
  e_n: number | null;
  /**
   * Whether both agree within their uncertainties.
   */
  agrees: boolean | null;
  /**
   * Its limit, mm.
   */
  tolerance_mm: number | null;
  /**
   * Part after part `pass`, `fail` or `undecided`, where there is a limit.
   */
  verdicts: string[];
  /**
   * What else is said about it.
   */
  note: string;
}
/**
 * One section of one part.
 */
export interface PartSectionEntry {
  /**
   * The number of the part, from 1.
   */
  part: number;
  /**
   * The file of its points.
   */
  file: string;
  /**
   * Height in the workpiece frame, mm.
   */
  z_mm: number;
  /**
   * Height above the base, mm.
   */
  height_mm: number;
  /**
   * Number of points.
   */
  points: number;
  /**
   * Nominal radius, mm.
   */
  nominal_radius_mm: number;
  /**
   * Radius of the least-squares circle, mm.
   */
  radius_mm: number;
  /**
   * Centre of the least-squares circle, mm.
   *
   * @minItems 2
   * @maxItems 2
   */
  centre_mm: [number, number];
  /**
   * Roundness about it, mm.
   */
  roundness_lsc_mm: number;
  /**
   * Width of the minimum zone, mm.
   */
  roundness_mzc_mm: number;
  /**
   * Width of the predicted minimum zone, mm; null without a study.
   */
  predicted_roundness_mzc_mm: number | null;
  /**
   * Azimuth of each point, deg.
   */
  azimuth_deg: number[];
  /**
   * E of each point, mm; positive: material left.
   */
  e_mm: number[];
}
/**
 * The same for a changed machine, without Monte Carlo, fast enough to follow a slider.
 */
export interface ServeWhatIfRequest {
  /**
   * The study file: a test piece.
   */
  study: string;
  /**
   * Changes of errors by ISO 230-1 name.
   */
  errors?: {
    [k: string]: ServeWhatIfRequestErrorChangeEntry;
  } | null;
  /**
   * The setting angles of rotary axes by name, degrees; those of the study if left out.
   */
  setting_deg?: {
    [k: string]: number;
  } | null;
  /**
   * The length of the tool, mm.
   */
  tool_length_mm?: number | null;
  /**
   * Temperatures, as `--temperature` of the command line.
   */
  temperature?: string | null;
}
/**
 * A change of one error: its curve times the factor, then the constant is added.
 */
export interface ServeWhatIfRequestErrorChangeEntry {
  /**
   * What its values are multiplied by; 1 if it is left out.
   */
  factor?: number | null;
  /**
   * What is added, a length or an angle with its unit, such as `5 urad`; nothing if it is left out.
   */
  add?: string | null;
}
/**
 * The prediction of a test piece. Arrays: for each point of all sections `azimuth_rad` (f32), `error_um` (f32:
 * the radial deviation) and `profile_mm` (f64: two, the actual point in the section).
 */
export interface ServeWhatIfPieceEntry {
  /**
   * The document of `trueaxis predict`.
   */
  document: PredictionDocument;
  /**
   * The machine file below the project folder; null if it is outside.
   */
  machine: string | null;
  /**
   * The names of the rotary axes.
   */
  rotary: string[];
  /**
   * The length of the tool, mm.
   */
  tool_length_mm: number;
  /**
   * The stated errors.
   */
  errors: ErrorUnitEntry[];
  /**
   * The names of the temperature sensors.
   */
  sensors: string[];
  /**
   * The sections, in the order of the arrays.
   */
  sections: SectionEntry[];
  /**
   * The problems of the study.
   */
  diagnostics: DiagnosticEntry[];
}
/**
 * A simulation of a program on a machine: `trueaxis/simulate/1`.
 */
export interface Simulate {
  /**
   * Which document this is.
   */
  schema: "trueaxis/simulate/1";
  /**
   * The version of the program `trueaxis`.
   */
  version: string;
  /**
   * The machine.
   */
  machine: SimulateMachineEntry;
  /**
   * The program file.
   */
  program: string;
  /**
   * The program and its subprograms; `program` elsewhere is an index into this list.
   */
  programs: string[];
  /**
   * The control.
   */
  control: string;
  /**
   * Whether a set-up was given; without one work offsets and tool lengths are 0.
   */
  set_up_given: boolean;
  /**
   * The result.
   */
  verdict: Verdict;
  /**
   * The whole time, s.
   */
  time_s: number;
  /**
   * Time of rapid moves, s.
   */
  rapid_s: number;
  /**
   * Time of dwells, s.
   */
  dwell_s: number;
  /**
   * Path length of the tool tip in the workpiece with feed, mm.
   */
  feed_mm: number;
  /**
   * The same of rapid moves, mm.
   */
  rapid_mm: number;
  /**
   * How many moves the program makes.
   */
  moves: number;
  /**
   * How many points of the path were computed.
   */
  nodes: number;
  /**
   * Smallest and largest coordinates of the nominal tool tip with feed, workpiece frame, mm; null if it never
   * moves with feed.
   *
   * @minItems 2
   * @maxItems 2
   */
  tip_box_mm: [[number, number, number], [number, number, number]] | null;
  /**
   * Every axis by its name, in chain order.
   */
  axes: {
    [k: string]: SimulateAxisEntry;
  };
  /**
   * The largest deviations of the actual tool from the nominal one.
   */
  deviation: SimulateDeviationEntry;
  /**
   * The first 1000 reversals of all axes, in order of time.
   */
  reversals: ReversalEntry[];
  /**
   * The issues that were found.
   */
  troubles: IssueEntry[];
  /**
   * How many stretches of issues there are in all: the sum of `stretches`.
   */
  troubles_found: number;
  /**
   * How many functions of the program that move the tool or its place are not executed: they are among the
   * diagnostics.
   */
  motion_left_out: number;
  /**
   * How many times the program asks for a speed of the spindle or a tool that the machine does not have: they are
   * among the diagnostics.
   */
  beyond_equipment: number;
  /**
   * Messages of the program to the operator.
   */
  messages: string[];
  /**
   * Stops in the program, optional ones not counted.
   */
  stops: number;
  /**
   * The tools in the order of their numbers.
   */
  tools: ToolEntry[];
  /**
   * The file that the path was written to; null if none was asked for.
   */
  path_file: string | null;
  /**
   * Temperatures during the program; null without a temperature log.
   */
  temperatures: TemperaturesEntry | null;
  /**
   * What became of the stock; null where it was not cut (`--stock`).
   */
  stock: StockEntry | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The machine.
 */
export interface SimulateMachineEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * Its kinematic chain from workpiece to tool.
   */
  chain: string;
}
/**
 * The motion of one axis.
 */
export interface SimulateAxisEntry {
  /**
   * Its unit: `mm` or `deg`.
   */
  unit: string;
  /**
   * The lowest position; null if the axis does not move. Unit: that of `unit`.
   */
  lowest: number | null;
  /**
   * The highest position; null if the axis does not move. Unit: that of `unit`.
   */
  highest: number | null;
  /**
   * The distance that it travels. Unit: that of `unit`.
   */
  travelled: number | null;
  /**
   * How often it changes its direction.
   */
  reversals: number;
  /**
   * Its highest speed, in its unit per second.
   */
  fastest_per_s: number | null;
  /**
   * The line of the program where that is.
   */
  fastest_line: number;
  /**
   * Its speed limit, in its unit per second; null if the machine file states none.
   */
  velocity_limit_per_s: number | null;
}
/**
 * The largest deviations of the actual tool from the nominal one, in the workpiece. Those along feed, normal and
 * binormal have a sign; the others are lengths.
 */
export interface SimulateDeviationEntry {
  /**
   * Tool tip with feed, µm.
   */
  tip_um: SimulateWorstEntry;
  /**
   * Root mean square of the tool tip over all points with feed, µm.
   */
  tip_rms_um: number;
  /**
   * Tool tip along the feed, µm.
   */
  feed_um: SimulateWorstEntry;
  /**
   * Tool tip along the normal: across the feed, on the side of the tool axis, µm.
   */
  normal_um: SimulateWorstEntry;
  /**
   * Tool tip along the binormal: across feed and normal, µm.
   */
  binormal_um: SimulateWorstEntry;
  /**
   * Tool axis with feed, µrad.
   */
  axis_urad: SimulateWorstEntry;
  /**
   * Tool tip, rapid moves included, µm.
   */
  tip_with_rapid_um: SimulateWorstEntry;
  /**
   * Tool axis, rapid moves included, µrad.
   */
  axis_with_rapid_urad: SimulateWorstEntry;
}
/**
 * Axis positions for a path of tool poses.
 */
export interface SolvePath {
  /**
   * Which document this is.
   */
  schema: "trueaxis/solve/1";
  /**
   * One for each pose of the path.
   */
  rows: SolveRowEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * The axis positions for one pose of a path.
 */
export interface SolveRowEntry {
  /**
   * The positions of the axes, mm and degrees.
   */
  axes: {
    [k: string]: number;
  };
}
/**
 * Axis positions for one tool pose.
 */
export interface Solve {
  /**
   * Which document this is.
   */
  schema: "trueaxis/solve/1";
  /**
   * All solutions of the nominal machine, the best first.
   */
  solutions: SolutionEntry[];
  /**
   * Whether an axis has no effect on the tool pose there.
   */
  singular: boolean;
  /**
   * The name of that axis, which keeps its angle; null if there is none.
   */
  held_axis: string | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * One solution.
 */
export interface SolutionEntry {
  /**
   * The positions of the axes, mm and degrees.
   */
  axes: {
    [k: string]: number;
  };
  /**
   * Whether all axes are within their travel.
   */
  within_limits: boolean;
  /**
   * How far the rotary axes turn to get there, degrees.
   */
  rotary_travel_deg: number;
}
/**
 * Many machines on many days: `trueaxis/study/1`.
 */
export interface Study {
  /**
   * Which document this is.
   */
  schema: "trueaxis/study/1";
  /**
   * The name of the study.
   */
  name: string;
  /**
   * Which samples there are.
   */
  design: DesignEntry;
  /**
   * What is varied.
   */
  inputs: InputEntry[];
  /**
   * What every machine makes.
   */
  cases: CaseEntry[];
  /**
   * What is asked of the machines; null if nothing is.
   */
  requirement: RequirementEntry | null;
  /**
   * `pass`, `fail` or `undecided`: whether it is met, at one combination if there are several; null if nothing is asked.
   */
  outcome: string | null;
  /**
   * The combinations of levels of a factorial design; else one.
   */
  combinations: StudyCombinationEntry[];
  /**
   * What makes the variance of each output; empty without a sensitivity analysis.
   */
  sensitivities: StudySensitivityEntry[];
}
/**
 * Which samples there are.
 */
export interface DesignEntry {
  /**
   * `monte-carlo`, `latin-hypercube`, `sobol` or `factorial`.
   */
  kind: string;
  /**
   * Machines, of each combination.
   */
  machines: number;
  /**
   * Days of each machine.
   */
  days: number;
  /**
   * The random seed.
   */
  seed: number;
  /**
   * Combinations of levels.
   */
  combinations: number;
  /**
   * Rows of the sensitivity analysis.
   */
  sensitivity_rows: number;
  /**
   * All samples.
   */
  samples: number;
}
/**
 * One input.
 */
export interface InputEntry {
  /**
   * Its name.
   */
  name: string;
  /**
   * The inputs whose effect is found together.
   */
  group: string;
  /**
   * `machine`, `day` or `hall`: how often it is drawn.
   */
  per: string;
  /**
   * `normal`, `uniform`, `triangular`, `arcsine` or `values`.
   */
  distribution: string;
  /**
   * The unit of mean and u: mm, rad, degC, s or 1.
   */
  unit: string;
  /**
   * Its mean. Unit: that of `unit`.
   */
  mean: number;
  /**
   * Its standard deviation. Unit: that of `unit`.
   */
  u: number;
}
/**
 * What every machine makes.
 */
export interface CaseEntry {
  /**
   * Its name in the study.
   */
  name: string;
  /**
   * Its study file.
   */
  study: string;
  /**
   * The machine.
   */
  machine: string;
}
/**
 * What is asked of the machines.
 */
export interface RequirementEntry {
  /**
   * The share of machines that hold their tolerances. Unit: 1.
   */
  machines_ratio: number;
  /**
   * On this share of days. Unit: 1.
   */
  days_ratio: number;
}
/**
 * One combination of levels.
 */
export interface StudyCombinationEntry {
  /**
   * The value of each factorial input.
   */
  levels: LevelEntry[];
  /**
   * The outputs, case after case.
   */
  outputs: OutputEntry[];
  /**
   * Machines and parts that hold all tolerances of each case; null for a case without any.
   */
  cases: (GoodEntry | null)[];
  /**
   * Those that hold all of them; null if there are none.
   */
  good: GoodEntry | null;
  /**
   * `pass`, `fail` or `undecided`; null if nothing is asked.
   */
  outcome: string | null;
}
/**
 * The value of a factorial input.
 */
export interface LevelEntry {
  /**
   * The input.
   */
  input: string;
  /**
   * Its unit: mm, rad, degC, s or 1.
   */
  unit: string;
  /**
   * Its value. Unit: that of `unit`.
   */
  value: number;
}
/**
 * The spread of one output.
 */
export interface OutputEntry {
  /**
   * Its case.
   */
  case: string;
  /**
   * Its key.
   */
  key: string;
  /**
   * The least value allowed; null without one, mm.
   */
  low_limit_mm: number | null;
  /**
   * The largest value allowed; null without one, mm.
   */
  high_limit_mm: number | null;
  /**
   * Mean of all machines and days, mm.
   */
  mean_mm: number;
  /**
   * Standard deviation; null of a single part, mm.
   */
  u_mm: number | null;
  /**
   * 2.5 % quantile, mm.
   */
  low_mm: number;
  /**
   * 97.5 % quantile, mm.
   */
  high_mm: number;
  /**
   * The smallest value, mm.
   */
  least_mm: number;
  /**
   * The largest value, mm.
   */
  largest_mm: number;
  /**
   * The share of parts on which it is in tolerance; null without a limit. Unit: 1.
   */
  good_ratio: number | null;
  /**
   * Standard deviation from machine to machine; null for one machine or one day, mm.
   */
  machines_u_mm: number | null;
  /**
   * From day to day, the same for all machines; null for one machine or one day, mm.
   */
  days_u_mm: number | null;
  /**
   * Of a machine on a day alone; null for one machine or one day, mm.
   */
  rest_u_mm: number | null;
  /**
   * Where the first cell of the histogram begins, mm.
   */
  histogram_from_mm: number;
  /**
   * The width of its cells, mm.
   */
  histogram_width_mm: number;
  /**
   * How many values each cell has.
   */
  histogram: number[];
}
/**
 * Machines and parts that hold their tolerances.
 */
export interface GoodEntry {
  /**
   * The share of parts. Unit: 1.
   */
  parts_ratio: number;
  /**
   * Its standard uncertainty; null where all machines have the same share. Unit: 1.
   */
  u_parts_ratio: number | null;
  /**
   * How many machines.
   */
  machines: number;
  /**
   * The share of machines. Unit: 1.
   */
  machines_ratio: number;
  /**
   * The ends of its interval of 95 %. Unit: 1.
   *
   * @minItems 2
   * @maxItems 2
   */
  machines_interval_ratio: [number, number];
}
/**
 * What makes the variance of one output.
 */
export interface StudySensitivityEntry {
  /**
   * Its case.
   */
  case: string;
  /**
   * Its key.
   */
  key: string;
  /**
   * The groups of inputs; null if the output does not vary.
   */
  groups: GroupEntry[] | null;
}
/**
 * The indices of Sobol' of one group.
 */
export interface GroupEntry {
  /**
   * The group.
   */
  group: string;
  /**
   * First index: of the group alone. Unit: 1.
   */
  first_ratio: number;
  /**
   * Its standard uncertainty. Unit: 1.
   */
  u_first_ratio: number;
  /**
   * Total index: with all interactions. Unit: 1.
   */
  total_ratio: number;
  /**
   * Its standard uncertainty. Unit: 1.
   */
  u_total_ratio: number;
}
/**
 * One block of a program through every stage of the simulation.
 */
export interface Trace {
  /**
   * Which document this is.
   */
  schema: "trueaxis/trace/1";
  /**
   * The machine.
   */
  machine: MachineEntry;
  /**
   * The file of the program.
   */
  program: string;
  /**
   * The block that was asked for: its number N, else its line.
   */
  block: number;
  /**
   * Its line in the program.
   */
  line: number;
  /**
   * Its text.
   */
  text: string;
  /**
   * How often it is executed; the first time is traced.
   */
  executions: number;
  /**
   * What the interpreter of the control makes of it.
   */
  programmed: ProgrammedEntry;
  /**
   * The points into which its path is divided.
   */
  nodes: NodeEntry[];
  /**
   * The positions of the axes, mm and degrees.
   */
  axes?: {
    [k: string]: number;
  };
  /**
   * The nominal tool in the workpiece frame.
   */
  nominal?: ToolPoseEntry;
  /**
   * The actual tool there.
   */
  actual?: ToolPoseEntry;
  /**
   * Actual − nominal.
   */
  deviation?: PathDeviationEntry;
  /**
   * When the block runs.
   */
  time?: TimeEntry;
  /**
   * The deviation at its end under each error alone; absent if nothing moves.
   */
  budget?: ShareEntry[] | null;
  /**
   * The place of every body at its end; absent if nothing moves.
   */
  bodies?: BodyEntry[] | null;
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * Measured test pieces against their tolerances and their prediction.
 */
export interface VerifyPart {
  /**
   * Which document this is.
   */
  schema: "trueaxis/verify-part/1";
  /**
   * The name of the file.
   */
  name: string;
  /**
   * The test piece.
   */
  test_piece: string;
  /**
   * What the prediction is.
   */
  prediction: string;
  /**
   * How many parts were measured.
   */
  parts: number;
  /**
   * The coverage factor k of U = k·u. Unit: 1.
   */
  coverage_factor: number;
  /**
   * The decision rule in words.
   */
  rule: string;
  /**
   * `pass`, `fail` or `undecided`: the parts against their tolerances.
   */
  verdict: string;
  /**
   * Why, in a sentence.
   */
  reason: string;
  /**
   * Whether the parts were measured in the frame of the best fit.
   */
  best_fit: boolean;
  /**
   * Index after index.
   */
  indices: PartIndexEntry[];
  /**
   * The circles of every section of every part that was measured by points.
   */
  sections: PartSectionEntry[];
  /**
   * What the reader of the numbers should know.
   */
  warnings: string[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
/**
 * Readings compared with a prediction, or with other readings.
 */
export interface Verify {
  /**
   * Which document this is.
   */
  schema: "trueaxis/verify/1";
  /**
   * The name of the comparison.
   */
  name: string;
  /**
   * What the readings are compared with: `prediction` or `readings`.
   */
  against: string;
  /**
   * How many readings.
   */
  readings: number;
  /**
   * The coverage factor k of U = k·u. Unit: 1.
   */
  coverage_factor: number;
  /**
   * The decision rule in words.
   */
  rule: string;
  /**
   * `pass`, `fail` or `undecided`.
   */
  verdict: string;
  /**
   * How many numbers pass.
   */
  pass: number;
  /**
   * How many fail.
   */
  fail: number;
  /**
   * How many are neither.
   */
  undecided: number;
  /**
   * The share of all numbers within U.
   */
  coverage: CoverageEntry;
  /**
   * By instrument.
   */
  instruments: PartEntry[];
  /**
   * By place, the worst first.
   */
  places: PlacePartEntry[];
  /**
   * What the readings make of what is stated of the set-up with an uncertainty.
   */
  set_up: SetUpEntry[];
  /**
   * Every number.
   */
  deviations: DifferenceEntry[];
  /**
   * The problems found in the input; the command line prints them on standard error, too.
   */
  diagnostics?: {
    /**
     * The code, such as `table-too-short`; `trueaxis explain CODE` has its meaning and its remedy.
     */
    code: string;
    /**
     * `error`: the input cannot be used; `warning`: it should be checked; `note`: information.
     */
    severity: string;
    /**
     * The file as the user named it, or an argument such as `--at`.
     */
    file: string;
    /**
     * The line, from 1; 0 for the file as a whole.
     */
    line: number;
    /**
     * The column in characters, from 1; 0 for the file as a whole.
     */
    column: number;
    /**
     * The problem in one sentence.
     */
    message: string;
    /**
     * What to do; empty if it follows from the message.
     */
    hint: string;
  }[];
}
