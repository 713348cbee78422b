"""The documents of answers as types: what `Answer.document` is.

Made by crates/trueaxis-python/documents.py from docs/schemas. An entry is there as an attribute and as an item; one whose
name Python has taken (`from`) only as an item. Entries that are marked so may be absent.
"""

from __future__ import annotations

from typing import Any, List, Literal, Mapping, Optional

from ._answers import Record


class BeforeAfterDocument(Record):
    """Virtual lasers before and after compensation."""
    #: Which document this is.
    schema: Literal["trueaxis/before-after/1"]
    #: Name of the campaign.
    name: str
    #: Name of the machine file.
    machine: str
    #: Name of the machine that was measured.
    measured: str
    #: Seed of the random numbers; each compensation has the next one.
    seed: int
    #: `values`, or `tables` of a control.
    added_by: str
    #: The least increment of a value of a linear axis, µm.
    increment_um: float
    #: The lasers.
    lasers: List[BeforeAfterDocument.LaserEntry]
    #: The readings, axis by axis.
    curves: List[BeforeAfterDocument.CurveEntry]
    #: The files that were written.
    files: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class LaserEntry(Record):
        """A laser."""
        #: Its name in the campaign.
        name: str
        #: What it is set to; null if it reads the machine alone.
        material: Optional[BeforeAfterDocument.MaterialEntry]

    class MaterialEntry(Record):
        """The compensation of a material in a laser."""
        #: Coefficient of expansion, 1e-6/K.
        expansion_um_per_m_k: float
        #: Temperature of the material, °C.
        celsius: float
        #: The sensor that it is read from; null if it was typed in.
        sensor: Optional[str]
        #: How much longer the material is than at 20 °C, µm/m.
        share_um_per_m: float
        #: Standard uncertainty of that, µm/m.
        u_um_per_m: float

    class CurveEntry(Record):
        """One laser on one axis under one compensation."""
        #: The axis.
        axis: str
        #: The laser.
        laser: str
        #: The path.
        path: str
        #: `none`, `machine` or `comprehensive`.
        compensation: str
        #: The mean of the runs that is farthest from 0, with its sign, µm.
        largest_um: float
        #: The target of it, mm.
        at_mm: float
        #: Standard uncertainty of this reading, µm.
        u_um: float
        #: Standard uncertainty of the error there by the machine file; null if it states none, µm.
        file_u_um: Optional[float]
        #: Their expanded uncertainties (k = 2), by the same keys.
        U_um: Mapping[str, Optional[float]]
        #: Every target.
        targets: List[BeforeAfterDocument.TargetEntry]

    class TargetEntry(Record):
        """A target."""
        #: Its position, mm.
        target_mm: float
        #: What was added to the command, mean of both directions, µm.
        added_um: float
        #: Mean deviation, rising; null if it was not approached so, µm.
        up_um: Optional[float]
        #: Mean deviation, falling; null if it was not approached so, µm.
        down_um: Optional[float]


class CertificateDocument(Record):
    """The certificate of a volumetric compensation."""
    #: Which document this is.
    schema: Literal["trueaxis/certificate/1"]
    #: The version of TrueAxis.
    version: str
    #: The name of the study.
    name: str
    #: `pass`, `fail` or `undecided`.
    verdict: str
    #: The reason in one sentence.
    reason: str
    #: Number, customer, place, instruments with their certificates; null where they are not stated.
    certificate: Optional[CertificateDocument.CertificateHead]
    #: The machine.
    machine: CertificateDocument.MachineEntry
    #: Its identified errors.
    errors: List[CertificateDocument.CertifiedErrorEntry]
    #: How they were determined.
    determination: CertificateDocument.DeterminationEntry
    #: How they are compensated.
    compensation: Any
    #: How the compensation was put into the control.
    application: CertificateDocument.ApplicationEntry
    #: The measurement with the compensation in effect, at poses that the determination did not use.
    validation: CertificateDocument.ValidationEntry
    #: The prediction for the zone in which the certificate holds.
    zone: CertificateDocument.ZoneEntry
    #: The decision.
    decision: CertificateDocument.DecisionEntry
    #: Every file that was read.
    inputs: List[CertificateDocument.FileEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class CertificateHead(Record):
        """The head of a certificate."""
        #: Its number.
        number: str
        #: For whom; null if it is not stated.
        customer: Optional[str]
        #: The serial number of the machine; null if it is not stated.
        machine_serial: Optional[str]
        #: Who measured; null if it is not stated.
        operator: Optional[str]
        #: Where; null if it is not stated.
        place: Optional[str]
        #: The date of the certificate, as written.
        date: str
        #: The instruments.
        instruments: List[CertificateDocument.InstrumentUsed]

    class InstrumentUsed(Record):
        """An instrument with its certificate."""
        #: Its name.
        name: str
        #: Its serial number; null if it is not stated.
        serial: Optional[str]
        #: The number of its certificate.
        certificate: str
        #: When it was calibrated, as written.
        calibrated: str
        #: Until when that is valid, as written; null if it is not stated.
        valid_until: Optional[str]
        #: Whether it is valid on the date of the certificate; null if no end is stated.
        is_valid: Optional[bool]

    class MachineEntry(Record):
        """A machine by its name."""
        #: Its name.
        name: str
        #: Its kinematic chain from the workpiece to the tool.
        chain: str

    class CertifiedErrorEntry(Record):
        """An identified error: `value_at_0_um`, its value at position 0 of its axis, and `u_um`, its largest standard uncertainty, µm; `…_urad`, µrad, of an angle."""
        #: Its ISO 230-1 name.
        error: str

    class DeterminationEntry(Record):
        """How the errors were determined."""
        #: The method in words.
        method: str
        #: The date, as written.
        date: str
        #: Who measured.
        by: str
        #: The instrument.
        instrument: str
        #: Its calibration.
        calibration: str
        #: The temperature. Unit: °C.
        temperature_c: float
        #: Its standard uncertainty; null if it is not stated. Unit: K.
        u_temperature_c: Optional[float]
        #: The source of their uncertainties: `machine file`, or a campaign of measurements.
        uncertainties_from: Any
        #: How many poses were used.
        poses_used: int

    class FileEntry(Record):
        """A file with its hash."""
        #: What it is.
        role: str
        #: Its name, relative to the study.
        name: str
        #: Its SHA-256, hexadecimal.
        sha256: str

    class ApplicationEntry(Record):
        """How the compensation was put into the control."""
        #: In words.
        method: Optional[str]
        #: The date, as written.
        date: Optional[str]
        #: Who did it.
        by: Optional[str]
        #: The folder with what the control has loaded; null if that was not compared.
        loaded: Optional[str]

    class ValidationEntry(Record):
        """The measurement with the compensation in effect."""
        #: The method in words.
        method: str
        #: The date, as written.
        date: str
        #: Who measured.
        by: str
        #: The instrument.
        instrument: str
        #: Its calibration.
        calibration: str
        #: The temperature. Unit: °C.
        temperature_c: float
        #: Its standard uncertainty; null if it is not stated. Unit: K.
        u_temperature_c: Optional[float]
        #: Where the instrument was set to zero, mm and degrees; null if it was not.
        zero: Optional[Mapping[str, float]]
        #: Standard uncertainty of one coordinate of a reading, µm.
        u_um: float
        #: Expanded uncertainty U = k·u of one coordinate of a reading, µm.
        expanded_um: float
        #: Root mean square of the tip deviation, µm.
        rms_um: CertificateDocument.StatesEntry
        #: Largest tip deviation, µm.
        largest_um: CertificateDocument.StatesEntry
        #: What was predicted.
        predicted: CertificateDocument.PredictedEntry
        #: Whether readings and prediction agree.
        agreement: CertificateDocument.StatesEntry2
        #: The poses.
        poses: List[CertificateDocument.CertifiedPoseEntry]

    class StatesEntry(Record):
        """A figure without and with the compensation."""
        #: Without the compensation.
        before: float
        #: With it.
        after: float

    class PredictedEntry(Record):
        """The prediction of the residual error at the poses of the validation."""
        #: All poses together are below this with the probability `share`, µm.
        largest_within_um: float
        #: Root mean square, µm.
        rms_um: float
        #: The probability. Unit: 1.
        share: float
        #: Monte Carlo samples.
        samples: int
        #: Their random seed.
        seed: int

    class StatesEntry2(Record):
        """A figure without and with the compensation."""
        #: Without the compensation.
        before: Optional[CertificateDocument.AgreementEntry]
        #: With it.
        after: Optional[CertificateDocument.AgreementEntry]

    class AgreementEntry(Record):
        """A χ² test of readings against the prediction."""
        #: χ² of the readings. Unit: 1.
        chi_square: float
        #: How many numbers.
        numbers: int
        #: The value that chance exceeds once in a hundred times. Unit: 1.
        limit: float
        #: Whether χ² is within it.
        holds: bool

    class CertifiedPoseEntry(Record):
        """A pose of the validation."""
        #: Its line in the table of readings.
        line: int
        #: The positions of the axes, mm and degrees.
        at: Mapping[str, float]
        #: The side of approach by axis, +1 or −1, where it is stated.
        approach: Mapping[str, float]
        #: Measured deviation of the tip without the compensation, µm.
        before_um: List[float]
        #: With it, µm.
        after_um: List[float]
        #: Predicted deviation of the tip without the compensation, µm.
        predicted_before_um: List[float]
        #: With it, µm.
        predicted_after_um: List[float]
        #: Expanded uncertainty of the prediction, µm.
        expanded_predicted_um: List[float]
        #: Predicted deviation of the tool axis with the compensation, µrad.
        predicted_axis_urad: List[float]
        #: Its expanded uncertainty, µrad.
        expanded_axis_urad: List[float]
        #: Length of `before_um`, µm.
        length_before_um: float
        #: Length of `after_um`, µm.
        length_after_um: float
        #: The predicted length is below this with 95 %, µm.
        predicted_within_um: float
        #: |measured − predicted| over its expanded uncertainty, of the worst coordinate.
        E_n: CertificateDocument.StatesEntry
        #: `pass`, `fail` or `undecided`.
        verdict: str

    class ZoneEntry(Record):
        """The prediction for the zone in which the certificate holds."""
        #: The ends by axis, mm or degrees.
        ends: Mapping[str, List[float]]
        #: How many poses were evaluated.
        poses: int
        #: Root mean square of the tip deviation without the compensation, µm.
        rms_before_um: float
        #: With it, µm.
        rms_after_um: float
        #: The largest with its uncertainty, µm.
        largest_um: float
        #: The positions of the axes there, mm and degrees.
        at: Mapping[str, float]

    class DecisionEntry(Record):
        """The decision."""
        #: The rule in words.
        rule: str
        #: The limit of the tip deviation, µm.
        limit_um: float
        #: The coverage factor k of U = k·u. Unit: 1.
        coverage_factor: float
        # ["pass"]: How many poses pass.
        #: How many fail.
        fail: int
        #: How many are neither.
        undecided: int


class CompensateDocument(Record):
    """Values that the control has to add to its commands: `trueaxis/compensate/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/compensate/1"]
    #: `values`.
    what: str
    #: The name of the machine.
    machine: str
    #: The values are added to the command.
    added_to: str
    #: One entry for each axis.
    axes: List[CompensateDocument.AxisValues]
    #: Where compensating the machine alone makes the part worse, or can.
    warnings: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class AxisValues(Record):
        """The values of one axis."""
        #: The axis.
        axis: str
        #: Which error is compensated: `comprehensive` or `machine`.
        of: str
        #: What the axis carries: `tool` or `workpiece`.
        carries: str
        #: The least increment, with its unit.
        increment: str
        #: The values by position.
        positions: List[CompensateDocument.PositionValue]

    class PositionValue(Record):
        """The value at one position."""
        #: The value in least increments.
        value_increments: int
        #: The value of rising positions; absent if both directions have one value. May be absent.
        value_up_increments: Optional[int]
        #: The value of falling positions; absent if both directions have one value. May be absent.
        value_down_increments: Optional[int]


class CompensateAdaptDocument(Record):
    """A path moved onto a measured blank: `trueaxis/compensate-adapt/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/compensate-adapt/1"]
    #: The name of the study.
    name: str
    #: The name of the machine.
    machine: str
    #: The file of the path.
    path: str
    #: `good`, `not applied` (words of the path are not) or `not to be cut`.
    verdict: str
    #: Words of the path that can change motion, spindle or coolant and are not applied; the exit status is then 1.
    not_applied: int
    #: What speaks against the path.
    findings: List[CompensateAdaptDocument.FindingEntry]
    #: How the blank lies.
    registration: CompensateAdaptDocument.RegistrationEntry
    #: The form of the blank.
    field: CompensateAdaptDocument.FieldEntry
    #: The places of the path.
    places: CompensateAdaptDocument.PlacesEntry
    #: The wall that remains.
    wall: CompensateAdaptDocument.WallEntry
    #: The wall place by place.
    map: List[CompensateAdaptDocument.CellEntry]
    #: The program of the adapted path; null if none was asked for.
    program: Optional[CompensateAdaptDocument.ProgramEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class FindingEntry(Record):
        """What speaks against the path."""
        #: Its name for programs.
        code: str
        #: The line of the path where it is worst.
        line: int
        #: At how many places it is so.
        places: int
        #: What was found.
        message: str

    class RegistrationEntry(Record):
        """How the blank lies, with standard uncertainties."""
        #: Which of its freedoms the path follows.
        follow: str
        #: The point about which it turns, mm.
        centre_mm: List[float]
        #: The shift, µm.
        shift_um: List[float]
        #: Its standard uncertainty, µm.
        u_shift_um: List[float]
        #: The turn, µrad.
        turn_urad: List[float]
        #: Its standard uncertainty, µrad.
        u_turn_urad: List[float]
        #: The freedoms that no reading determines, held at zero.
        held: List[str]

    class FieldEntry(Record):
        """The form of the blank as a smooth field."""
        #: How many points were probed.
        points: int
        #: The length over which the form changes, mm.
        length_mm: float
        #: The standard deviation of the form, µm.
        form_um: float
        #: The standard deviation of a reading, µm.
        noise_um: float
        #: The standard uncertainty that all readings share, in full part of that of the field, µm.
        common_um: float
        #: Each point predicted by all others: root mean square of the difference, µm.
        left_out_rms_um: float
        #: The share of these differences within U (k = 2). Unit: 1.
        left_out_within_u2: float
        #: The factor by which the uncertainty was raised. Unit: 1.
        raised: float
        #: Points that do not fit.
        outliers: List[CompensateAdaptDocument.OutlierEntry]

    class OutlierEntry(Record):
        """A point that does not fit."""
        #: Its number. Unit: 1.
        point: float
        #: Its line in the table.
        line: int
        #: Reading − field, µm.
        residual_um: float
        #: The same in its standard uncertainty. Unit: 1.
        z: float

    class PlacesEntry(Record):
        """The places of the path."""
        #: How many there are.
        all: int
        #: At how many the cutter touches the part.
        cut: int
        #: The smallest and the largest move along the normal, µm.
        moved_um: List[float]
        #: The largest standard uncertainty of the move, µm.
        largest_u_um: float

    class WallEntry(Record):
        """The wall that remains."""
        #: The nominal thickness, mm.
        thickness_mm: float
        #: The layer to be removed, mm.
        layer_mm: float
        #: The least thickness, mm.
        least_mm: float
        #: Where the map comes from.
        source: str
        #: As programmed.
        before: CompensateAdaptDocument.WallSpread
        #: Adapted.
        after: CompensateAdaptDocument.WallSpread
        #: The smallest and the largest distance from an equal layer, µm.
        off_equal_layer_um: List[float]

    class WallSpread(Record):
        """The wall over all places of the map."""
        #: The thinnest, mm.
        min_mm: float
        #: The mean, mm.
        mean_mm: float
        #: The thickest, mm.
        max_mm: float
        #: At how many places it is cut through.
        cut_through: int
        #: How many places the map has.
        places: int

    class CellEntry(Record):
        """One place of the map."""
        #: Where it is, mm.
        at_mm: List[float]
        #: The blank there, µm along the normal.
        blank_um: float
        #: The field there, µm along the normal.
        field_um: float
        #: Its standard uncertainty, µm.
        u_field_um: float
        #: The wall as programmed, mm.
        wall_before_mm: float
        #: The wall adapted, mm.
        wall_after_mm: float
        #: Its standard uncertainty, mm.
        u_wall_mm: float

    class ProgramEntry(Record):
        """The program of the adapted path."""
        #: Where it goes.
        file: str
        #: Whether it was written: only if its proof holds and nothing speaks against the path.
        written: bool
        #: Blocks that move the tool along the path.
        blocks: int
        #: The largest distance of the tip, read back, from the adapted path, µm.
        tip_on_path_um: float
        #: Of the tool axis, deg.
        axis_on_path_deg: float


class CompensateProgramDocument(Record):
    """A program rewritten for the actual machine, with its proof: `trueaxis/compensate-program/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/compensate-program/1"]
    #: The name of the machine.
    machine: str
    #: The program as it was.
    program: str
    #: The compensated program.
    output: str
    #: Blocks that move the tool.
    blocks: int
    #: Blocks of these that were divided.
    split: int
    #: Blocks that were written for all of them.
    pieces: int
    #: Circles that became lines.
    circles_to_lines: int
    #: Words that were added to blocks.
    words_added: int
    #: The first thousand of them.
    additions: List[CompensateProgramDocument.AddedWord]
    #: Computed words that have a correction added.
    expressions_corrected: int
    #: The first thousand of them.
    expressions: List[CompensateProgramDocument.CorrectedExpression]
    #: Whether the written program, read back, keeps the residual: only then it is written.
    proved: bool
    #: Blocks of rotary axes alone with a new F, so that they take the same time.
    feeds_changed: int
    #: Places where an axis reverses by less than its reversal error.
    undecided_reversals: int
    #: Cuts that begin where no corrected word leads, as after a move to machine zero: their ways are not part of the proof.
    begins_elsewhere: int
    #: Blocks that stay as they are, by reason.
    left: Mapping[str, int]
    #: Places where the tool axis keeps its deviation, by reason.
    axis_left: Mapping[str, int]
    #: Whether only the tip was corrected.
    position_only: bool
    #: How far the tip may be missed between the ends of blocks, mm.
    residual_mm: float
    #: How far the tool axis may be missed there, rad.
    residual_axis_rad: float
    #: The least increments; null if numbers were not rounded.
    increments: Optional[CompensateProgramDocument.IncrementsEntry]
    #: The largest deviations of the program as it was.
    before: CompensateProgramDocument.ResidualEntry
    #: Of the compensated program, read back.
    after: CompensateProgramDocument.ResidualEntry
    #: How many ends of blocks were compared.
    ends_compared: int
    #: The blocks with the largest deviations after compensation.
    worst_blocks: List[CompensateProgramDocument.BlockEntry]
    #: The largest correction of each axis.
    largest_corrections: List[CompensateProgramDocument.AxisCorrection]
    #: The largest relative change of the path length of the tip in a block. Unit: 1.
    way_change_relative: float
    #: How well the corrections are known.
    uncertainty: CompensateProgramDocument.UncertaintyEntry
    #: What would be left without correction and with a wrong sign.
    convention_check: List[CompensateProgramDocument.ConventionEntry]
    #: What to know of this program.
    remarks: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class AddedWord(Record):
        """A word that a block did not have."""
        #: The line of the program as it was.
        line: int
        #: The axis.
        axis: str

    class CorrectedExpression(Record):
        """A computed word that has a correction added."""
        #: The line of the program as it was.
        line: int
        #: The expression as it was.
        was: str
        # ["is"]: What stands there now; in Klartext the calculation before the block.

    class IncrementsEntry(Record):
        """The least increments."""
        #: Of linear axes, mm.
        linear_mm: float
        #: Of rotary axes, deg.
        rotary_deg: float

    class ResidualEntry(Record):
        """The largest deviations of the actual tool."""
        #: Of the tip at the ends of blocks, µm.
        tip_at_ends_um: CompensateProgramDocument.LineValue
        #: Of the tool axis at the ends of blocks, µrad.
        axis_at_ends_urad: CompensateProgramDocument.LineValue
        #: Of the tip between the ends, µm.
        tip_between_um: CompensateProgramDocument.LineValue
        #: Of the tool axis between the ends, µrad.
        axis_between_urad: CompensateProgramDocument.LineValue
        #: Root mean square of the tip over the ends of blocks, µm.
        tip_at_ends_rms_um: float
        #: Of the tool axis over the ends of blocks, µrad.
        axis_at_ends_rms_urad: float

    class LineValue(Record):
        """A value and the line of the program where it occurs."""
        #: The value. Unit: that of the key.
        value: float
        #: The line of the program as it was, from 1.
        line: int

    class BlockEntry(Record):
        """One block."""
        #: The line of the program as it was, from 1.
        line: int
        #: Deviation of the tip before, µm.
        tip_before_um: float
        #: Deviation of the tip after, µm.
        tip_after_um: float
        #: Deviation of the tool axis before, µrad.
        axis_before_urad: float
        #: Deviation of the tool axis after, µrad.
        axis_after_urad: float

    class AxisCorrection(Record):
        """The largest correction of one axis."""
        #: The axis.
        axis: str
        #: The correction. Unit: that of `unit`.
        value: float
        #: Its unit.
        unit: str
        #: The line of the program as it was, from 1.
        line: int

    class UncertaintyEntry(Record):
        """How well the corrections are known."""
        #: Places that were examined.
        places: int
        #: Of these, where the correction is smaller than its standard uncertainty.
        smaller_than_u: int
        #: The largest standard uncertainty of the tip, µm.
        largest_u_um: float

    class ConventionEntry(Record):
        """The block with the largest correction under another convention."""
        #: Which convention.
        what: str
        #: Deviation of the tip, µm.
        tip_um: float
        #: Deviation of the tool axis, µrad.
        axis_urad: float


class CompensateTablesDocument(Record):
    """Tables of one control, and what they leave of the errors: `trueaxis/compensate-tables/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/compensate-tables/1"]
    #: The name of the machine.
    machine: str
    #: The control, as `--target` names it.
    target: str
    #: The files that were written.
    files: List[str]
    #: The values are added to the command.
    added_to: str
    #: Where the other axes stand for each table, mm and deg.
    reference: Mapping[str, float]
    #: The tables.
    tables: List[CompensateTablesDocument.TableEntry]
    #: Errors that the control's own chain holds.
    known: List[CompensateTablesDocument.KnownEntry]
    #: Lines by which the control follows temperatures.
    temperature: List[CompensateTablesDocument.LineEntry]
    #: Rotary axes in the control's kinematics.
    kinematics: List[CompensateTablesDocument.JointEntry]
    #: The grid of corrections in space; null if there is none.
    grid: Optional[CompensateTablesDocument.GridEntry]
    #: What was left out, and why.
    left_out: List[CompensateTablesDocument.LeftOutEntry]
    #: The errors that the tables represent.
    represents: List[str]
    #: The errors that they cannot represent.
    cannot: List[CompensateTablesDocument.LossEntry]
    #: Deviation of the tool over the travel without tables, µm.
    before_um: CompensateTablesDocument.ResidualEntry
    #: The same with the tables, µm.
    left_um: CompensateTablesDocument.ProvedEntry
    #: The same after the part zero was set with the tables in force, the axes at `reference`, µm.
    left_zero_set_um: CompensateTablesDocument.ResidualEntry
    #: The same if the control took them with the wrong sign, µm.
    wrong_sign_um: CompensateTablesDocument.ResidualEntry
    #: What to do at the control.
    notes: List[str]
    #: What tables of the machine alone can cost; present only where the temperature of the workpiece is not known. May be absent.
    machine_only: Optional[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class TableEntry(Record):
        """One table: what is added to one axis by the position of another."""
        #: The axis by whose position the table is read.
        input: str
        #: The axis to which it adds.
        output: str
        #: How many nodes it has.
        nodes: int
        #: Whether the two directions of travel have values of their own.
        by_direction: bool
        #: Whether it repeats after a turn.
        modulo: bool
        #: The node that adds most; absent if there is none. May be absent.
        check: Optional[CompensateTablesDocument.CheckEntry]

    class CheckEntry(Record):
        """A node to check the sign by."""
        #: Its position. Unit: mm or deg.
        position: float

    class KnownEntry(Record):
        """An error that the control's own chain holds."""
        #: Its ISO 230-1 name.
        error: str
        #: How many nodes; 1 if it is constant.
        nodes: int

    class LineEntry(Record):
        """A line by which the control follows the temperature of a scale."""
        #: The axis.
        axis: str
        #: The position at which only the offset is added. Unit: mm or deg.
        reference: float
        #: The slope, µm/m or µrad/rad.
        slope_um_per_m: float

    class JointEntry(Record):
        """A rotary axis as the control holds it."""
        #: The axis.
        axis: str
        #: A point on it, mm.
        point_mm: List[float]
        #: Its direction, a unit vector. Unit: 1.
        direction: List[float]
        #: By how much the point is off the nominal one, µm.
        moved_um: List[float]
        #: By how much the direction is off the nominal one, µrad.
        tilted_urad: List[float]

    class GridEntry(Record):
        """A grid of corrections in space."""
        #: Its sides.
        sides: List[CompensateTablesDocument.SideEntry]
        #: How many points.
        points: int
        #: What is lost between the points, µm.
        loss_um: float
        #: The largest correction, µm.
        largest_um: float

    class SideEntry(Record):
        """A side of the grid."""
        #: The axis.
        axis: str
        #: The first point, mm.
        from_mm: float
        #: The distance of two points, mm.
        step_mm: float
        #: How many points.
        points: int

    class LeftOutEntry(Record):
        """A table or an error that was left out."""
        #: Why.
        reason: str

    class LossEntry(Record):
        """An error that the tables cannot represent, alone on the machine."""
        #: Its ISO 230-1 name.
        error: str
        #: Deviation of the tip without tables, µm.
        before_um: float
        #: With the tables, µm.
        left_um: float
        #: Where it could be compensated.
        instead: str

    class ResidualEntry(Record):
        """Deviation of the tool over the travel of all axes."""
        #: The largest of the tip. Unit: µm.
        max: float
        #: Root mean square of the tip. Unit: µm.
        rms: float
        #: Where the largest is, mm and deg.
        at: Mapping[str, float]
        #: How many poses, each from both sides.
        poses: int
        #: The largest of the tool axis, µrad.
        axis_urad: float

    class ProvedEntry(Record):
        """The same with the files read back, and on a test piece."""
        #: The largest of the tip. Unit: µm.
        max: float
        #: Root mean square of the tip. Unit: µm.
        rms: float
        #: Where the largest is, mm and deg.
        at: Mapping[str, float]
        #: How many poses, each from both sides.
        poses: int
        #: The largest of the tool axis, µrad.
        axis_urad: float
        #: The test piece; null if none was asked for.
        test_piece: Optional[CompensateTablesDocument.PieceEntry]
        #: The part by its drawing; absent if none was asked for. May be absent.
        part: Optional[CompensateTablesDocument.PartWithTablesEntry]

    class PieceEntry(Record):
        """A test piece cut with the tables."""
        #: The study.
        study: str
        #: Its indices.
        indices: List[CompensateTablesDocument.PieceIndex]

    class PieceIndex(Record):
        """One index of the test piece."""
        #: Its key.
        index: str
        #: Without tables, µm.
        before_um: float
        #: With the tables, µm.
        left_um: float

    class PartWithTablesEntry(Record):
        """A part by its drawing, before and with the tables. Outcomes are `pass`, `fail` or `undecided`."""
        #: The study.
        study: str
        #: Without tables.
        outcome: str
        #: With them, the zero where it was set without them.
        zero_kept_outcome: str
        #: With them, the zero set again.
        zero_set_outcome: str
        #: The lines of the drawing.
        characteristics: List[CompensateTablesDocument.CharacteristicWithTables]

    class CharacteristicWithTables(Record):
        """A characteristic before and with the tables."""
        #: Its name.
        name: str
        #: Without tables, µm.
        before_um: float
        #: With them, the zero where it was set without them, µm.
        zero_kept_um: float
        #: With them, the zero set again, µm.
        zero_set_um: float
        #: Without tables.
        outcome: str
        #: With them, the zero kept.
        zero_kept_outcome: str
        #: With them, the zero set again.
        zero_set_outcome: str


class DiffDocument(Record):
    """Two calibrations of one machine: which errors have changed."""
    #: Which document this is.
    schema: Literal["trueaxis/diff/1"]
    #: The version of TrueAxis.
    version: str
    #: The name of the newer machine.
    machine: str
    #: Its kinematic chain from the workpiece to the tool.
    chain: str
    #: The older file.
    old: str
    #: The newer file.
    new: str
    #: The names of the errors that have changed significantly.
    moved: List[str]
    #: The bound of the change of one error in its standard uncertainty, so that among all errors none is above it by chance with 95 %. Unit: 1.
    limit_u: float
    #: All errors.
    errors: List[DiffDocument.ErrorChangeEntry]
    #: What the changes do to the tip.
    tip: DiffDocument.TipChangeEntry
    #: The tables that hold at two temperatures.
    temperatures: List[DiffDocument.TwoTemperaturesEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class ErrorChangeEntry(Record):
        """How one error has changed, where the change is clearest."""
        #: Its ISO 230-1 name.
        error: str
        #: The unit of its values: `um` or `urad`.
        unit: str
        #: Its old value; null if the old file does not state it. Unit: that of `unit`.
        old: Optional[float]
        #: Its new value; null if the new file does not state it. Unit: that of `unit`.
        new: Optional[float]
        #: New − old. Unit: that of `unit`.
        change: Optional[float]
        #: Root mean square of the change over the travel. Unit: that of `unit`.
        rms_change: float
        #: Standard uncertainty of the change; null if a file states none. Unit: that of `unit`.
        u_change: Optional[float]
        #: |change| over its expanded uncertainty (k = 2), ISO 13528. Unit: 1.
        E_n: Optional[float]
        #: The position; null for location errors.
        at: Optional[DiffDocument.AxisPositionEntry]
        #: `yes`, `perhaps`, `no`, `unknown`, `new` (only in the new file) or `gone` (only in the old one).
        moved: str

    class AxisPositionEntry(Record):
        """A position of one axis."""
        #: The name of the axis.
        axis: str
        #: Its position. Unit: that of `unit`.
        position: float
        #: `mm` or `deg`.
        unit: str
        #: The side from which it is approached: +1, −1, or 0 for the mean of both. Unit: 1.
        approach: float

    class TipChangeEntry(Record):
        """What the changes do to the tip."""
        #: How many poses were evaluated.
        poses: int
        #: The largest change of the tip, µm.
        largest_um: float
        #: Its standard uncertainty, µm.
        u_um: float
        #: The axis positions of the largest change, mm and degrees.
        at: Mapping[str, float]
        #: Root mean square over the poses, µm.
        rms_um: float
        #: The largest change of the tool axis, µrad.
        axis_largest_urad: float
        #: The largest difference of the nominal machines at the tip, mm; 0 if they are the same.
        nominal_difference_mm: float
        #: The change of each error alone, the largest first.
        shares: List[DiffDocument.TipShareEntry]

    class TipShareEntry(Record):
        """The change of one error alone."""
        #: Its ISO 230-1 name.
        error: str
        #: How far it moves the tip at most, µm.
        largest_um: float

    class TwoTemperaturesEntry(Record):
        """A table of the older file, referred to the temperature of that of the newer one."""
        #: The error.
        error: str
        #: The temperature of the older table.
        old_degC: float
        #: That of the newer one.
        new_degC: float
        #: The expansion by which the older one is referred; null where no file states one: both are compared as they are.
        expansion_um_per_m_k: Optional[float]


class EvaluateDocument(Record):
    """An evaluation of readings by a standard, with what it says of the machine file: `trueaxis/evaluate/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/evaluate/1"]
    #: The version of the program.
    version: str
    #: The standard, such as `iso230-2`.
    standard: str
    #: The file of the readings.
    file: str
    #: The name of the measurement; null if none is stated.
    name: Optional[str]
    #: The machine; null if none is stated.
    machine: Optional[str]
    #: The axis; null if none is stated.
    axis: Optional[str]
    #: The instrument; null if none is stated.
    instrument: Optional[str]
    #: The date of the measurement; null if none is stated.
    date: Optional[str]
    #: The temperature; null if none is stated. Unit: °C.
    temperature_degC: Optional[float]
    #: Figures against their tolerances; null where none has one.
    decisions: Optional[EvaluateDocument.DecisionsEntry]
    #: A circle as errors of the machine file; absent where no machine is named. May be absent.
    machine_errors: Optional[EvaluateDocument.MachineErrorsEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class DecisionsEntry(Record):
        """Figures against their tolerances."""
        #: `ISO 14253-1` or `simple`.
        rule: str
        #: `conforming`, `not conforming` or `neither proved`: the worst of all.
        decision: str
        #: Every figure that has a tolerance.
        figures: List[EvaluateDocument.DecisionEntry]

    class DecisionEntry(Record):
        """A figure with its tolerance."""
        #: Its name.
        figure: str
        #: Effective degrees of freedom of U; null for infinitely many, and where U is not known. Unit: 1.
        degrees_of_freedom: Optional[float]
        #: The coverage factor of U; null where U is not known. Unit: 1.
        k: Optional[float]
        #: `conforming`, `not conforming` or `neither proved`.
        decision: str

    class PositioningEntry(Record):
        """Positioning of an axis. Deviations of linear axes end in `_um` (µm), those of rotary axes are given twice, in `_urad` (µrad) and `_arcsec` (arcseconds). For each unit there are the quantities `A`, `A_up`, `A_down`, `R`, `R_up`, `R_down`, `E`, `E_up`, `E_down`, `M`, `B` and `B_mean` of ISO 230-2, then an object `U` with their expanded uncertainties (k = 2)."""
        #: `linear` or `rotary`.
        kind: str
        #: The measured length of a linear axis, mm. May be absent.
        travel_mm: Optional[float]
        #: The measured angle of a rotary axis, degrees. May be absent.
        travel_deg: Optional[float]
        #: Every target position.
        positions: List[EvaluateDocument.PositionEntry]
        #: Standard uncertainties by ISO/TR 230-9, each key with its unit; null if nothing is known of the instrument. An entry is null where it does not apply.
        budget: Optional[Mapping[str, Optional[float]]]
        #: `P`, `Pa`, `Ps` and `U` of VDI/DGQ 3441, each key with its unit; null where the readings do not allow it.
        vdi3441: Mapping[str, Optional[float]]
        #: The quantities in the form of ASME B5.54, each key with its unit; null where the readings do not allow it.
        b5_54_form: Mapping[str, Optional[float]]

    class PositionEntry(Record):
        """One target position. For each unit there are the means `mean_up`, `mean_down` and `mean`, the standard deviations `s_up` and `s_down`, the reversal value `B` and the repeatabilities `R_up`, `R_down` and `R`."""
        #: The target of a linear axis, mm. May be absent.
        target_mm: Optional[float]
        #: The target of a rotary axis, degrees. May be absent.
        target_deg: Optional[float]
        #: How many readings were approached in the positive direction.
        n_up: int
        #: How many readings were approached in the negative direction.
        n_down: int

    class GeometricEntry(Record):
        """A geometric test."""
        #: `straightness`, `flatness`, `squareness` or `parallelism`.
        kind: str
        #: The machine error that it is, such as `EYX`; null if none is stated.
        error: Optional[str]
        #: All quantities; the first one is judged.
        quantities: List[EvaluateDocument.GeometricQuantityEntry]
        #: What is allowed of the first quantity, µm; null without tolerance or for an angle.
        tolerance_um: Optional[float]
        #: What is allowed of the first quantity, µrad; null without tolerance or for a length.
        tolerance_urad: Optional[float]
        #: `pass`, `fail` or `undecided` by ISO 14253-1; null without tolerance.
        outcome: Optional[str]
        #: Standard deviation of a reading from runs or closure, µm; null if it is not known or an angle.
        reading_s_um: Optional[float]
        #: Standard deviation of a reading from runs or closure, µrad; null if it is not known or a length.
        reading_s_urad: Optional[float]
        #: Degrees of freedom of this standard deviation; null without it. Unit: 1.
        degrees_of_freedom: Optional[float]
        #: The lines about their reference.
        lines: List[EvaluateDocument.GeometricLineEntry]
        #: The points of a surface.
        surface: List[EvaluateDocument.SurfacePointEntry]
        #: The closure errors of the lines of a surface.
        closures: List[EvaluateDocument.ClosureEntry]

    class GeometricQuantityEntry(Record):
        """A quantity of a geometric test: in µm or in µrad."""
        #: Its name; of a squareness the machine error.
        name: str
        #: Its value, µm; null for an angle.
        value_um: Optional[float]
        #: Its expanded uncertainty, 95 %, µm; null for an angle, or if it is not known.
        u_um: Optional[float]
        #: Its value, µrad; null for a length.
        value_urad: Optional[float]
        #: Its expanded uncertainty, 95 %, µrad; null for a length, or if it is not known.
        u_urad: Optional[float]

    class GeometricLineEntry(Record):
        """A line about its reference."""
        #: Which.
        name: str
        #: Positions, mm.
        positions_mm: List[float]
        #: Deviations, µm.
        deviations_um: List[float]

    class SurfacePointEntry(Record):
        """A point of a surface."""
        #: Place, mm.
        x_mm: float
        #: Place, mm.
        y_mm: float
        #: Deviation from the reference plane, µm.
        deviation_um: float

    class ClosureEntry(Record):
        """What the closure of a surface changed of a line."""
        #: The line.
        line: str
        #: How far its own profile is from the surface, at most, µm.
        largest_um: float

    class CircularEntry(Record):
        """A circular test by ISO 230-4. For each sense (`ccw`, `cw`), the worst of its paths, there are `G_ccw_um`, `F_ccw_max_um` and `F_ccw_min_um`, then the same over all paths: `G_um`, `G_b_um`, `F_max_um`, `F_min_um` and `D_um`."""
        #: The two axes.
        axes: List[str]
        #: The nominal radius, mm; null if none is stated.
        radius_mm: Optional[float]
        #: The centre that deviations are counted from, mm.
        centre_mm: List[float]
        #: Every path.
        paths: List[EvaluateDocument.PathEntry]
        #: The causes of the deviations; null if they cannot be separated.
        causes: Optional[EvaluateDocument.CausesEntry]
        #: All causes with uncertainties and shares; null without a whole circle in both directions and its radius.
        diagnosis: Optional[EvaluateDocument.DiagnosisEntry]

    class PathEntry(Record):
        """One path of a circular test."""
        #: `ccw` or `cw`.
        direction: str
        #: How many points it has.
        points: int
        #: The overlap that was left out, degrees.
        overlap_left_out_deg: float
        #: Circular deviation, µm.
        G_um: float
        #: Largest radial deviation, µm; null without a nominal radius.
        F_max_um: Optional[float]
        #: Smallest radial deviation, µm; null without a nominal radius.
        F_min_um: Optional[float]
        #: Mean radial deviation, µm; null without a nominal radius.
        mean_radial_um: Optional[float]
        #: Centre of the least-squares circle, mm.
        centre_mm: List[float]
        #: Its radius, mm.
        mean_radius_mm: float

    class CausesEntry(Record):
        """The causes of the deviations of a circular test, by least squares."""
        #: Reversal error of each axis, µm.
        backlash_um: Mapping[str, float]
        #: Scale of the first axis − that of the second, over the diameter, µm.
        scale_mismatch_um: float
        #: Squareness, positive if closer than 90°, µrad; null if one sense alone cannot separate it.
        squareness_urad: Optional[float]
        #: Servo mismatch, counterclockwise along +45°, µm; null if one sense alone cannot separate it.
        servo_mismatch_um: Optional[float]
        #: Squareness and servo mismatch together, µm; null if they are separated.
        diagonal_ellipse_um: Optional[float]
        #: The centre, µm.
        centre_um: List[float]
        #: The spikes at the reversals.
        spikes: List[EvaluateDocument.SpikeEntry]
        #: Root mean square of the residuals, µm.
        residual_rms_um: float

    class SpikeEntry(Record):
        """A spike after a reversal."""
        #: The axis that reverses.
        axis: str
        #: Where on the circle, degrees.
        at_deg: float
        #: `ccw` or `cw`.
        direction: str
        #: Largest residual after the reversal, outward positive, µm.
        height_um: float

    class DiagnosisEntry(Record):
        """The causes of a circle with their uncertainties and shares."""
        #: The causes, the largest share first.
        causes: List[EvaluateDocument.CauseEntry]
        #: Standard deviation of the residuals, µm.
        residual_um: float
        #: Degrees of freedom of the residuals, which follow each other closely. Unit: 1.
        degrees_of_freedom: float
        #: By how much the axes lag one another, s; null where no feed is stated.
        servo_lag_s: Optional[float]

    class CauseEntry(Record):
        """One cause: its value with U, in µm or µrad, and what it does to the circle."""
        #: `squareness`, `scale-mismatch`, `size`, `servo-mismatch`, `backlash`, `lateral-play`, `straightness`, `cyclic-error`, `reversal-spike` or `unexplained`.
        cause: str
        #: The axis that it belongs to; null where it belongs to both.
        axis: Optional[str]
        #: Its value, µm; null for an angle.
        value_um: Optional[float]
        #: Its expanded uncertainty (95.45 %), µm; null for an angle.
        U_um: Optional[float]
        #: Its value, µrad; null for a length.
        value_urad: Optional[float]
        #: Its expanded uncertainty (95.45 %), µrad; null for a length.
        U_urad: Optional[float]
        #: Effective degrees of freedom (Welch-Satterthwaite); null for infinitely many. Unit: 1.
        degrees_of_freedom: Optional[float]
        #: The coverage factor of U. Unit: 1.
        k: float
        #: A backlash where the axis reverses at its positive and its negative end, µm; null for others.
        ends_um: Optional[List[float]]
        #: The bidirectional circular deviation that it makes alone, µm.
        alone_um: float
        #: Its part of the sum of all these, percent.
        share_percent: float

    class DriftEntry(Record):
        """Drift by ISO 230-3."""
        #: Length of the windows, s.
        window_s: float
        #: How long the test lasts, s.
        duration_s: Optional[float]
        #: Every channel.
        channels: List[EvaluateDocument.ChannelEntry]

    class ChannelEntry(Record):
        """One channel: `range`, `first_window`, `largest_window`, `largest_window_at_most` (if it changes within gaps of the record at the worst moment) and `end`, each with the unit `_um`, `_urad` or `_degC`."""
        #: Its name.
        name: str
        #: Where the window of the largest range begins, s.
        largest_window_from_s: float

    class DiagonalsEntry(Record):
        """Diagonals by ISO 230-6: the largest of all, then each. A value is null if the readings do not allow it."""
        #: Bidirectional systematic deviation, µm.
        E_d_um: Optional[float]
        #: Systematic deviation in the positive direction, µm.
        E_d_up_um: Optional[float]
        #: Systematic deviation in the negative direction, µm.
        E_d_down_um: Optional[float]
        #: Bidirectional repeatability, µm.
        R_d_um: Optional[float]
        #: Reversal value, µm.
        B_d_um: Optional[float]
        #: Bidirectional accuracy, µm.
        A_d_um: Optional[float]
        #: Every diagonal.
        diagonals: List[EvaluateDocument.DiagonalEntry]
        #: Squareness from pairs of diagonals.
        squareness: List[EvaluateDocument.SquarenessEntry]

    class DiagonalEntry(Record):
        """One diagonal."""
        #: Its name by the signs of the axes.
        diagonal: str
        #: Its elongation, µm/m; null if the readings do not allow it.
        stretch_um_per_m: Optional[float]
        #: `linear` or `rotary`.
        kind: str
        #: The measured length of a linear axis, mm. May be absent.
        travel_mm: Optional[float]
        #: The measured angle of a rotary axis, degrees. May be absent.
        travel_deg: Optional[float]
        #: Every target position.
        positions: List[EvaluateDocument.PositionEntry]
        #: Standard uncertainties by ISO/TR 230-9, each key with its unit; null if nothing is known of the instrument. An entry is null where it does not apply.
        budget: Optional[Mapping[str, Optional[float]]]
        #: `P`, `Pa`, `Ps` and `U` of VDI/DGQ 3441, each key with its unit; null where the readings do not allow it.
        vdi3441: Mapping[str, Optional[float]]
        #: The quantities in the form of ASME B5.54, each key with its unit; null where the readings do not allow it.
        b5_54_form: Mapping[str, Optional[float]]

    class SquarenessEntry(Record):
        """Squareness of two axes, as their diagonals suggest it."""
        #: The two axes.
        axes: str
        #: By how much they are closer than 90°, µrad.
        closer_urad: float
        # ["from"]: `body` or `face` diagonals.

    class RotationEntry(Record):
        """Error motions of a rotary axis by ISO 230-7."""
        #: How many full revolutions were evaluated.
        revolutions: int
        #: Readings in each revolution.
        readings_per_revolution: int
        #: Readings outside the full revolutions.
        readings_left_out: int
        #: The error motions.
        motions: List[EvaluateDocument.MotionEntry]

    class MotionEntry(Record):
        """One error motion."""
        #: The sensitive direction.
        sensitive: str
        #: Total error motion, µm.
        total_um: float
        #: Synchronous error motion, µm.
        synchronous_um: float
        #: Asynchronous error motion, µm; null for one revolution.
        asynchronous_um: Optional[float]
        #: The part once per revolution, µm.
        fundamental_um: float

    class ProbingEntry(Record):
        """A probing test."""
        #: The quantities.
        quantities: List[EvaluateDocument.ProbingQuantityEntry]
        #: Standard deviation of a hit at one point, µm; null without repeated hits.
        hit_s_um: Optional[float]
        #: Degrees of freedom of it; null without repeated hits. Unit: 1.
        degrees_of_freedom: Optional[float]
        #: The deviations of rings and spheres.
        deviations: List[EvaluateDocument.ProbingDeviationsEntry]

    class ProbingQuantityEntry(Record):
        """A quantity of a probing test."""
        #: Its name.
        name: str
        #: Its value, µm.
        value_um: float
        #: Its expanded uncertainty, 95 %, µm; null of a range of repeated readings, or if it is not known.
        u_um: Optional[float]
        #: What is allowed, µm; null without tolerance.
        tolerance_um: Optional[float]
        #: `pass`, `fail` or `undecided`; null without tolerance.
        outcome: Optional[str]

    class ProbingDeviationsEntry(Record):
        """The deviations of a ring or sphere from its least-squares element."""
        #: Which.
        name: str
        #: Angles in the plane x y, degrees.
        angles_deg: List[float]
        #: Height angles over this plane, degrees; 0 of a ring.
        heights_deg: List[float]
        #: Deviations of the radius, µm.
        deviations_um: List[float]

    class MachineErrorsEntry(Record):
        """A circle as errors of the machine file."""
        #: The errors that change.
        written: List[EvaluateDocument.WrittenEntry]
        #: The causes that change nothing, and why.
        left: List[EvaluateDocument.LeftEntry]
        #: Every cause in the readings and as the virtual ball-bar of the machine file shows it, before and after.
        compared: List[EvaluateDocument.ComparedEntry]
        #: Standard deviation of reading − virtual ball-bar of the machine file as it was, µm.
        residual_before_um: float
        #: The same of the new machine file, µm.
        residual_after_um: float

    class WrittenEntry(Record):
        """An error of the machine file that changes."""
        #: Its ISO 230-1 name.
        error: str
        #: What the file states now.
        value: str
        #: The causes that it states.
        causes: List[str]

    class LeftEntry(Record):
        """A cause that changes nothing."""
        #: Which.
        cause: str
        #: Of which axis; null where it belongs to both.
        axis: Optional[str]
        #: Why.
        why: str

    class ComparedEntry(Record):
        """A cause before and after."""
        #: Which.
        cause: str
        #: Of which axis; null where it belongs to both.
        axis: Optional[str]
        #: `um` or `urad`: the unit of the numbers.
        unit: str
        #: From the readings. Unit: that of `unit`.
        read: float
        #: From the machine file as it was. Unit: that of `unit`.
        before: float
        #: From the new machine file. Unit: that of `unit`.
        after: float


class EvaluateFormDocument(Record):
    """The form of points: `trueaxis/evaluate-form/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/evaluate-form/1"]
    #: The version of the program.
    version: str
    #: The file of the points.
    file: str
    #: `line`, `plane`, `circle`, `sphere`, `cylinder` or `cone`.
    element: str
    #: What its form deviation is called, such as `roundness`.
    deviation: str
    #: How many points the file has.
    points: int
    #: The normal of the plane of a profile or circle, if it is known. Unit: 1.
    plane_normal: Optional[List[float]]
    #: The filter; null if there is none.
    filter: Optional[str]
    #: The reference element that decides: `LSC`, `MZC`, `MCC` or `MIC`.
    reference: str
    #: The form deviation by it, µm.
    form_um: float
    #: Its expanded uncertainty, µm; null if nothing is known of the points.
    U_um: Optional[float]
    #: The tolerance, µm; null if there is none.
    tolerance_um: Optional[float]
    #: `pass`, `fail` or `undecided` by ISO 14253-1; null without a tolerance.
    decision: Optional[str]
    #: The least-squares element.
    least_squares: EvaluateFormDocument.LeastSquaresEntry
    #: Every reference element.
    references: List[EvaluateFormDocument.ReferenceEntry]
    #: Angle with points, degrees; null for lines and planes.
    covered_deg: Optional[float]
    #: Deviations of the points from the deciding element, after the filter, µm.
    deviations_um: List[float]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class LeastSquaresEntry(Record):
        """The least-squares element with standard uncertainties (k = 1); null where nothing is known of the points."""
        #: Centre, or point of the element next to the middle of the points, mm.
        point_mm: List[float]
        #: Its standard uncertainty, mm.
        point_u_mm: Optional[List[float]]
        #: Direction of the line or axis, or normal; null for a sphere. Unit: 1.
        direction: Optional[List[float]]
        #: Its standard uncertainty. Unit: 1.
        direction_u: Optional[List[float]]
        #: Angle to the nearest axis of the frame, degrees; null for a sphere.
        tilt_deg: Optional[float]
        #: That axis.
        tilt_to: Optional[str]
        #: Its standard uncertainty, degrees.
        tilt_u_deg: Optional[float]
        #: Radius, of a cone at its point; null for lines and planes, mm.
        radius_mm: Optional[float]
        #: Its standard uncertainty, mm.
        radius_u_mm: Optional[float]
        #: Half of the angle at the apex of a cone, degrees.
        half_angle_deg: Optional[float]
        #: Its standard uncertainty, degrees.
        half_angle_u_deg: Optional[float]
        #: Apex of a cone, mm.
        apex_mm: Optional[List[float]]
        #: Standard deviation of the residuals, µm.
        residual_um: float
        #: Their degrees of freedom.
        degrees_of_freedom: int
        #: Standard deviation along the normal of a circle, if its plane was fitted, µm.
        axial_residual_um: Optional[float]
        #: Standard uncertainty of a point that the others follow from, µm.
        point_uncertainty_um: Optional[float]
        #: Where it comes from: `stated`, `scatter`, or `scatter, larger than stated`.
        uncertainty_from: Optional[str]
        #: k for U of these values. Unit: 1.
        coverage_factor: Optional[float]

    class ReferenceEntry(Record):
        """One reference element."""
        #: `LSC`, `MZC`, `MCC` or `MIC`.
        reference: str
        #: The form deviation, µm.
        form_um: float
        #: Its expanded uncertainty, µm.
        U_um: Optional[float]
        #: Its standard deviation by noise of the points, µm.
        noise_u_um: Optional[float]
        #: What noise adds to it at most, µm.
        noise_bias_um: Optional[float]
        #: Centre, or point of the element, mm.
        point_mm: List[float]
        #: Direction or normal; null for a sphere. Unit: 1.
        direction: Optional[List[float]]
        #: Radius; null for lines and planes, mm.
        radius_mm: Optional[float]
        #: Half of the angle at the apex of a cone, degrees.
        half_angle_deg: Optional[float]
        #: `global`, `bound`, `local` or `none`; null for least squares.
        proof: Optional[str]
        #: With `bound`: no other element has a smaller form deviation (inscribed: larger radius) than this, mm.
        bound_mm: Optional[float]
        #: With `local`: starts that were tried, and those that came to this result.
        starts: Optional[List[int]]
        #: The points that hold it.
        contacts: List[EvaluateFormDocument.ContactEntry]

    class ContactEntry(Record):
        """A point that holds an element."""
        #: Its number, from 1, after the filter.
        point: int
        #: `outer` or `inner`.
        side: str
        #: Its multiplier. Unit: 1.
        weight: float


class HistoryDocument(Record):
    """Figures of one machine over its calibrations: `trueaxis/history/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/history/1"]
    #: The version of the program.
    version: str
    #: The machine.
    machine: str
    #: Whether nothing needs attention: no jump, no point outside of the control limits, no limit exceeded.
    quiet: bool
    #: Every figure with at least two dates.
    series: List[HistoryDocument.SeriesEntry]
    #: Figures with one date only.
    single: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class SeriesEntry(Record):
        """A figure over time."""
        #: Its name.
        figure: str
        #: The unit of its numbers: `um`, `urad`, `arcsec`.
        unit: str
        #: Its points by date.
        points: List[HistoryDocument.PointEntry]
        #: Change in a year. Unit: that of `unit`.
        slope_per_year: Optional[float]
        #: Its expanded uncertainty (95.45 %); null where nothing is known of it. Unit: that of `unit`.
        U_slope_per_year: Optional[float]
        #: Its degrees of freedom; null for infinitely many. Unit: 1.
        degrees_of_freedom: Optional[float]
        #: Its coverage factor. Unit: 1.
        k: Optional[float]
        #: Lower limit, mean and upper limit of the chart of individuals; null below three points. Unit: that of `unit`.
        control_limits: Optional[List[float]]
        #: The dates of points outside of them.
        outside: List[str]
        #: Changes beyond U of both calibrations.
        jumps: List[HistoryDocument.JumpEntry]
        #: The limit; null where none is stated. Unit: that of `unit`.
        limit: Optional[float]
        #: Whether the last value is beyond the limit; null where none is stated.
        exceeded: Optional[bool]
        #: When the trend reaches the limit; null if not within a century.
        reached: Optional[str]
        #: The same as early as U of the slope allows.
        reached_earliest: Optional[str]

    class PointEntry(Record):
        """A figure on a day."""
        #: The date.
        date: str
        #: The value. Unit: that of `unit`.
        value: float
        #: Its standard uncertainty; null where none is stated. Unit: that of `unit`.
        u: Optional[float]
        #: The file.
        file: str

    class JumpEntry(Record):
        """A change from one calibration to the next."""
        # ["from"]: From when.
        #: To when.
        to: str
        #: The change. Unit: that of `unit`.
        change: float
        #: Its expanded uncertainty (k = 2). Unit: that of `unit`.
        U: float


class IdentifyErrorsDocument(Record):
    """Errors identified from the readings of a campaign."""
    #: Which document this is.
    schema: Literal["trueaxis/identify/1"]
    #: Name of the campaign.
    name: str
    #: Name of the machine.
    machine: str
    #: Date of the measurement as written; null if none is stated.
    date: Optional[str]
    #: Whether the model explains the readings.
    verdict: IdentifyErrorsDocument.VerdictEntry
    #: The stages one after the other; empty if the campaign has none.
    stages: List[IdentifyErrorsDocument.StageEntry]
    #: The largest difference between the stages and all readings at once, in standard uncertainties; null without stages. Unit: 1.
    stages_differ_by_u: Optional[float]
    #: The errors of the machine.
    errors: List[IdentifyErrorsDocument.FoundEntry]
    #: The errors of the set-up of the instruments.
    setup: List[IdentifyErrorsDocument.FoundEntry]
    #: Combinations of errors that change no reading.
    unobservable: List[IdentifyErrorsDocument.Unobservable]
    #: Candidate terms that the readings do not support.
    left_out: List[str]
    #: Root mean square of the residual of length readings, in sample, µm; null without such readings.
    rms_in_um: Optional[float]
    #: The same on places that the model had not seen, µm.
    rms_held_out_um: Optional[float]
    #: Repeatability of the readings, µm.
    repeatability_um: Optional[float]
    #: Whether the repeatability comes from repeated readings; if not, it is the stated noise.
    repeatability_is_measured: bool
    #: Root mean square without the unknown errors, set-up only, µm.
    rms_without_model_um: Optional[float]
    #: The same figures for lengths and angles.
    rms: IdentifyErrorsDocument.RmsEntries
    #: Number of readings.
    readings: int
    #: Number of places.
    places: int
    #: Rank of the design matrix.
    rank: int
    #: Its condition number. Unit: 1.
    condition: float
    #: Relative singular value below which a combination counts as unobservable. Unit: 1.
    threshold: float
    #: `full` or `linear`.
    model: str
    #: χ² of the fit. Unit: 1.
    chi_square: float
    #: Its degrees of freedom.
    degrees_of_freedom: int
    #: The feeds of the readings, and the lags that they cannot separate.
    feeds: IdentifyErrorsDocument.Feeds
    #: Factor by which the uncertainties are enlarged, 1 or more. Unit: 1.
    birge_ratio: float
    #: The test of the residual.
    test: IdentifyErrorsDocument.TestEntry
    #: The largest coverage factor of the values. Unit: 1.
    coverage_factor: float
    #: What the residual follows, the most evident first.
    residual_follows: List[IdentifyErrorsDocument.FieldEntry]
    #: How well readings are predicted; null if that was not asked for.
    prediction: Optional[IdentifyErrorsDocument.PredictionEntry]
    #: How the terms were selected.
    selection: IdentifyErrorsDocument.SelectionEntry
    #: Readings beyond the limit of studentised residuals.
    outliers: List[IdentifyErrorsDocument.OutlierEntry]
    #: That limit, in standard deviations. Unit: 1.
    outlier_limit: float
    #: The readings that change the result most if they are left out.
    most_influential: List[IdentifyErrorsDocument.InfluenceEntry]
    #: The conventions that were tried; null if that was not asked for.
    conventions: Optional[IdentifyErrorsDocument.ConventionCheck]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class VerdictEntry(Record):
        """The result."""
        #: `explained`, `over-fitted`, `follows-xyz`, `turns-with-axis`, `arrangement`, `reverses`, `drifts`, `gross-readings`, `unexplained` or `stages-contradict`.
        key: str
        #: In words.
        words: str
        #: Whether the model may be trusted.
        good: bool

    class StageEntry(Record):
        """A stage for programs."""
        #: Its name.
        name: str
        #: When it was done, as written; null if none is stated.
        date: Optional[str]
        #: How many numbers were read.
        numbers: int
        #: What was found without the axes of the machine, in words.
        found: List[str]
        #: By how much its readings scatter more than stated, 1 or more. Unit: 1.
        birge_ratio: float
        #: Whether it agrees with the stages before it; null if they say nothing of the same.
        agreement: Optional[IdentifyErrorsDocument.AgreementEntry]
        #: Every unknown after this stage.
        known: List[IdentifyErrorsDocument.StageValue]

    class AgreementEntry(Record):
        """The test of a stage against the stages before it."""
        #: χ². Unit: 1.
        chi_square: float
        #: Its degrees of freedom.
        degrees_of_freedom: int
        #: Probability of a larger χ² by chance. Unit: 1.
        p: float
        #: Whether they contradict each other.
        conflict: bool
        #: The unknown that differs most; null if none can be compared alone.
        worst: Optional[str]

    class StageValue(Record):
        """An unknown after a stage."""
        #: Its name.
        name: str
        #: `um`, `urad`, `ms` or `um/m`.
        unit: str
        #: Its value; null if it is not known yet. Unit: that of `unit`.
        value: Optional[float]
        #: Its standard uncertainty. Unit: that of `unit`.
        u: Optional[float]
        #: Its standard uncertainty before this stage; null if it was not known. Unit: that of `unit`.
        u_before: Optional[float]

    class FoundEntry(Record):
        """One unknown."""
        #: Its name.
        name: str
        #: The standard uncertainty again. Unit: that of the value.
        u: Optional[float]
        #: Value divided by its standard uncertainty. Unit: 1.
        z: Optional[float]
        #: Effective degrees of freedom of u; null if they are infinite or the value is not observable. Unit: 1.
        degrees_of_freedom: Optional[float]
        #: k for 95.45 %; null if not observable. Unit: 1.
        coverage_factor: Optional[float]

    class Unobservable(Record):
        """A combination of unknowns that changes no reading."""
        #: As a sum.
        combination: str
        #: In words.
        words: str
        #: A set-up that makes it observable; null if none of those tried does.
        resolve_with: Optional[str]

    class RmsEntries(Record):
        """Root mean squares of the residual."""
        #: Of the readings that the model was fitted to.
        in_sample: IdentifyErrorsDocument.RmsEntry
        #: Of places that the model had not seen.
        held_out: IdentifyErrorsDocument.RmsEntry
        #: Of repeated readings, or the stated noise.
        repeatability: IdentifyErrorsDocument.RmsEntry
        #: Without the unknown errors, set-up only.
        without_model: IdentifyErrorsDocument.RmsEntry

    class RmsEntry(Record):
        """A root mean square."""
        #: Of lengths, µm; null without such readings.
        um: Optional[float]
        #: Of angles, µrad; null without such readings.
        urad: Optional[float]
        #: In units of the stated noise. Unit: 1.
        times_noise: float

    class Feeds(Record):
        """The feeds of a campaign; empty if none is stated."""
        #: Every feed, the slowest first.
        counts: List[IdentifyErrorsDocument.FeedCount]
        #: Lags that these readings cannot separate from errors of the machine or the set-up.
        not_separable: List[IdentifyErrorsDocument.SharedLag]

    class FeedCount(Record):
        """Readings at one feed."""
        #: Feed of the tool against the workpiece, mm/min; 0 standing.
        feed_mm_per_min: float
        #: How many readings.
        readings: int

    class SharedLag(Record):
        """What lag of one axis cannot be separated from."""
        #: `lag Y`.
        name: str
        #: The share of its effect on the readings that other errors have too, 0 to 1. Unit: 1.
        share: float
        #: The errors for which it passes, the largest first.
        passes_for: List[IdentifyErrorsDocument.PassesFor]

    class PassesFor(Record):
        """An error for which lag passes."""
        #: Its name.
        name: str
        #: How much of it 1 ms of lag pretends. Unit: that of `unit`.
        per_ms: float
        #: `um` or `urad`.
        unit: str

    class TestEntry(Record):
        """The test of the residual against noise or repeatability."""
        #: `chi-square` against the stated noise, or `F` against repeated readings.
        statistic: str
        #: Its value. Unit: 1.
        value: float
        #: What it exceeds by chance, at this level; null without degrees of freedom. Unit: 1.
        limit: Optional[float]
        #: How often a good campaign exceeds it. Unit: 1.
        level: float
        #: Degrees of freedom of the residual. Unit: 1.
        degrees_of_freedom: float
        #: Those of the repeatability; null for `chi-square`. Unit: 1.
        degrees_of_freedom_of_repeats: Optional[float]

    class FieldEntry(Record):
        """A part of the residual."""
        #: The letter of an axis, `arrangement` (location errors), `approach` or `time`.
        what: str
        #: The share of the squares of the residual that this kind of error, which is not listed, would explain alone, 0 to 1. Unit: 1.
        share: float

    class PredictionEntry(Record):
        """How well readings are predicted, by all errors together."""
        #: On the readings themselves.
        in_sample: IdentifyErrorsDocument.RmsEntry
        #: On readings that were held out.
        held_out: List[IdentifyErrorsDocument.HeldOutEntry]

    class HeldOutEntry(Record):
        """Readings that were predicted without them."""
        #: The rotary axis of which one angle after the other was held out; null: a part of the places.
        axis: Optional[str]
        #: How many parts.
        parts: int
        #: The residual by the listed errors alone.
        listed: IdentifyErrorsDocument.RmsEntry
        #: The residual by all errors, listed or not.
        all: IdentifyErrorsDocument.RmsEntry

    class SelectionEntry(Record):
        """How the terms were selected."""
        #: Number of candidate terms.
        candidates: int
        #: Least |z| of a term that is kept; null if none is. Unit: 1.
        least_z: Optional[float]
        #: The limits that were tried.
        scores: List[IdentifyErrorsDocument.Score]

    class Score(Record):
        """How well a threshold predicts."""
        #: Least |z| of a term that is kept; ∞ (null): none is, 0: all are. Unit: 1.
        least_z: Optional[float]
        #: Number of candidate terms that are kept.
        terms: int
        #: Root mean square of the residual on parts that were held out, in units of the noise. Unit: 1.
        held_out_times_noise: float
        #: The same on the readings themselves. Unit: 1.
        in_sample_times_noise: float

    class OutlierEntry(Record):
        """A reading that does not fit."""
        #: Its file.
        file: str
        #: Its line there.
        line: int
        #: Its channel, from 1.
        channel: int
        #: Its studentised residual. Unit: 1.
        studentised: float

    class InfluenceEntry(Record):
        """A reading and its influence on the result."""
        #: Its file.
        file: str
        #: Its line there.
        line: int
        #: Its leverage, 0 to 1. Unit: 1.
        leverage: float
        #: Cook's distance; null if the result depends on this reading alone. Unit: 1.
        cook: Optional[float]

    class ConventionCheck(Record):
        """The conventions that were tried."""
        #: Number of changes tried.
        tried: int
        #: The residual as the readings are, in units of the noise. Unit: 1.
        residual_times_noise: float
        #: Changes that fit far better, the best first.
        better: List[IdentifyErrorsDocument.Convention]
        #: What cannot be checked, or what to look at.
        remarks: List[str]

    class Convention(Record):
        """A change of convention that fits far better."""
        #: What to change, in words.
        change: str
        #: The residual without the change, in units of the noise. Unit: 1.
        before_times_noise: float
        #: The residual with the change, in units of the noise. Unit: 1.
        after_times_noise: float


class IdentifyExpansionDocument(Record):
    """The coefficient of expansion and the error table of a scale."""
    #: Which document this is.
    schema: Literal["trueaxis/identify/1"]
    #: The name of the study.
    name: str
    #: The letter of its axis, where it is stated. May be absent.
    axis: Optional[str]
    #: The coefficient of expansion by least squares over all runs, µm/(m·K).
    expansion_um_per_m_k: float
    #: Its standard uncertainty, µm/(m·K).
    u_um_per_m_k: float
    #: The coefficient from the slopes of the coldest and the warmest run alone, µm/(m·K).
    slope_difference_um_per_m_k: float
    #: Standard deviation of the residual error, µm.
    residual_um: float
    #: Materials of scales that the coefficient allows within ± 2 u.
    materials: List[str]
    #: The runs.
    runs: List[IdentifyExpansionDocument.RunEntry]
    #: The temperature of the scale at which the error table holds, °C.
    table_temperature_celsius: float
    #: The error table: actual − nominal, as the laser reads it.
    table: List[IdentifyExpansionDocument.TableRow]
    #: The cubic spline through the table (not-a-knot), piece by piece.
    spline: List[IdentifyExpansionDocument.PieceRow]
    #: What the reader should know.
    warnings: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class RunEntry(Record):
        """A run of the laser."""
        #: Its name.
        name: str
        #: The temperature of the scale, °C.
        temperature_celsius: float
        #: The slope of its straight line, µm/m.
        slope_um_per_m: float

    class TableRow(Record):
        """A row of the error table."""
        #: The position, mm.
        position_mm: float
        #: The positioning error, µm.
        error_um: float
        #: Its standard uncertainty, µm.
        u_um: float

    class PieceRow(Record):
        """A piece of the spline: with h = position − from, e = ((a·h + b)·h + c)·h + d, µm."""
        #: Where it begins, mm.
        from_mm: float
        #: Where it ends, mm.
        to_mm: float
        #: a, µm/mm³.
        a_um_per_mm3: float
        #: b, µm/mm².
        b_um_per_mm2: float
        #: c, µm/mm.
        c_um_per_mm: float
        #: d, µm.
        d_um: float


class IdentifyExpansionsDocument(Record):
    """Several scales."""
    #: Which document this is.
    schema: Literal["trueaxis/identify-expansions/1"]
    #: Each of them.
    scales: List[IdentifyExpansionsDocument.ExpansionDocument]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class ExpansionDocument(Record):
        """The coefficient of expansion and the error table of a scale."""
        #: Which document this is.
        schema: Literal["trueaxis/identify/1"]
        #: The name of the study.
        name: str
        #: The letter of its axis, where it is stated. May be absent.
        axis: Optional[str]
        #: The coefficient of expansion by least squares over all runs, µm/(m·K).
        expansion_um_per_m_k: float
        #: Its standard uncertainty, µm/(m·K).
        u_um_per_m_k: float
        #: The coefficient from the slopes of the coldest and the warmest run alone, µm/(m·K).
        slope_difference_um_per_m_k: float
        #: Standard deviation of the residual error, µm.
        residual_um: float
        #: Materials of scales that the coefficient allows within ± 2 u.
        materials: List[str]
        #: The runs.
        runs: List[IdentifyExpansionsDocument.RunEntry]
        #: The temperature of the scale at which the error table holds, °C.
        table_temperature_celsius: float
        #: The error table: actual − nominal, as the laser reads it.
        table: List[IdentifyExpansionsDocument.TableRow]
        #: The cubic spline through the table (not-a-knot), piece by piece.
        spline: List[IdentifyExpansionsDocument.PieceRow]
        #: What the reader should know.
        warnings: List[str]

    class RunEntry(Record):
        """A run of the laser."""
        #: Its name.
        name: str
        #: The temperature of the scale, °C.
        temperature_celsius: float
        #: The slope of its straight line, µm/m.
        slope_um_per_m: float

    class TableRow(Record):
        """A row of the error table."""
        #: The position, mm.
        position_mm: float
        #: The positioning error, µm.
        error_um: float
        #: Its standard uncertainty, µm.
        u_um: float

    class PieceRow(Record):
        """A piece of the spline: with h = position − from, e = ((a·h + b)·h + c)·h + d, µm."""
        #: Where it begins, mm.
        from_mm: float
        #: Where it ends, mm.
        to_mm: float
        #: a, µm/mm³.
        a_um_per_mm3: float
        #: b, µm/mm².
        b_um_per_mm2: float
        #: c, µm/mm.
        c_um_per_mm: float
        #: d, µm.
        d_um: float


class IdentifyProbeDocument(Record):
    """The calibration of a touch probe."""
    #: Its name. May be absent.
    stylus: str
    #: Range of the radii as measured, µm. May be absent.
    range_before_um: float
    #: The same with only the offset corrected, µm. May be absent.
    range_offset_only_um: float
    #: The same corrected, µm. May be absent.
    range_after_um: float
    #: The same corrected, directions held out, µm. May be absent.
    range_held_out_um: float
    #: Root mean square as measured, µm. May be absent.
    rms_before_um: float
    #: The same corrected, µm. May be absent.
    rms_after_um: float
    #: The same corrected, directions held out, µm. May be absent.
    rms_held_out_um: float
    #: The least and the greatest measured radius, mm. May be absent.
    radius_before_mm: List[float]
    #: Ball − spindle with the spindle at 0, mm; null if not observable. May be absent.
    offset_mm: Optional[List[float]]
    #: Its standard uncertainties, mm. May be absent.
    u_offset_mm: Optional[List[float]]
    #: Centre of the gauge, mm. May be absent.
    centre_mm: List[float]
    #: Whether that is stated. May be absent.
    centre_known: bool
    #: By how much an offset from four hits alone differs, µm. May be absent.
    four_hit_bias_um: List[float]
    #: The model of the pre-travel: `fourier` or `spline`. May be absent.
    model: str
    #: Its highest harmonic, or its number of knots. May be absent.
    size: int
    #: Harmonics of the pre-travel; the first is part of the offset. May be absent.
    harmonics: List[IdentifyProbeDocument.HarmonicEntry]
    #: The sizes of model that were tried. May be absent.
    scores: List[IdentifyProbeDocument.ProbeScoreEntry]
    #: Number of hits. May be absent.
    hits: int
    #: Standard deviation of one hit, µm. May be absent.
    s_um: float
    #: Degrees of freedom of the fit. May be absent.
    degrees_of_freedom: int
    #: Factor from u to U (95 %). Unit: 1. May be absent.
    coverage_factor: float
    #: Orientations of the spindle, degrees. May be absent.
    orientations_deg: List[float]
    #: Widest gap between directions, degrees. May be absent.
    widest_gap_deg: float
    #: Repeated hits; null if there are none. May be absent.
    repeatability: Optional[IdentifyProbeDocument.RepeatsEntry]
    #: Form error after ISO 230-10; null if the hits do not allow it. May be absent.
    iso230_10: Optional[IdentifyProbeDocument.FormEntry]
    #: Fresh hits that were not used in the fit; null if there are none. May be absent.
    check: Optional[IdentifyProbeDocument.FreshCheckEntry]
    #: Orientation of the spindle for the table below, degrees. May be absent.
    table_orientation_deg: float
    #: Deviations by direction of motion. May be absent.
    table: List[IdentifyProbeDocument.DirectionEntry]
    #: Deviation of each hit as measured, µm. May be absent.
    deviations_um: List[float]
    #: Residual of each hit, µm. May be absent.
    left_um: List[float]
    #: Residual of each hit, its direction held out, µm. May be absent.
    held_out_um: List[float]
    #: Which document this is.
    schema: Literal["trueaxis/identify-probe/1"]
    #: Name of the study.
    name: str
    #: The dial gauge on the turning ball; null if not measured.
    eccentricity: Optional[IdentifyProbeDocument.EccentricityEntry]
    #: The length of the probe; null if not measured.
    z_datum: Optional[IdentifyProbeDocument.ZDatumEntry]
    #: The plain calibration with four hits; null if not measured.
    xy_datum: Optional[IdentifyProbeDocument.XyDatum]
    #: The results of all styli.
    styli: List[IdentifyProbeDocument.StylusEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class HarmonicEntry(Record):
        """A harmonic of the pre-travel."""
        #: Its order.
        order: int
        #: Power of the sine of the latitude (spheres).
        axial: int
        #: Its amplitude, µm.
        amplitude_um: float
        #: Direction of its first lobe, degrees.
        phase_deg: float
        #: Its cosine term, µm.
        cosine_um: float
        #: Its sine term, µm.
        sine_um: float
        #: Standard uncertainty of each of the two, µm.
        u_um: float

    class ProbeScoreEntry(Record):
        """One size of model."""
        #: `fourier` or `spline`.
        model: str
        #: Its highest harmonic, or its number of knots.
        size: int
        #: Number of its parameters.
        parameters: int
        #: Root mean square of the residual in sample, µm.
        rms_in_um: float
        #: The same with directions held out, µm.
        rms_held_out_um: float
        #: Whether it was chosen.
        chosen: bool

    class RepeatsEntry(Record):
        """Repeated hits."""
        #: Number of directions with repeated hits.
        directions: int
        #: Their standard deviation, µm.
        s_um: float
        #: Their largest range, µm.
        range_um: float

    class FormEntry(Record):
        """A form error after ISO 230-10."""
        #: Its symbol.
        figure: str
        #: The number of hits that the standard asks for.
        hits_of_the_standard: int
        #: As measured, µm.
        before_um: float
        #: Corrected, µm.
        after_um: float
        #: Whether the clause was checked in the text of the standard.
        checked_on_the_page: bool

    class FreshCheckEntry(Record):
        """Fresh hits that were not used in the fit."""
        #: Number of hits.
        hits: int
        #: As measured.
        before: IdentifyProbeDocument.SpreadEntry
        #: Corrected.
        after: IdentifyProbeDocument.SpreadEntry
        #: Share of the hits within U (95 %), 0 to 1. Unit: 1.
        within_U: float

    class SpreadEntry(Record):
        """The spread of radii."""
        #: Greatest − least, µm.
        range_um: float
        #: Root mean square, µm.
        rms_um: float

    class DirectionEntry(Record):
        """The deviation in one direction of motion."""
        #: The direction of motion, degrees.
        angle_deg: float
        #: Deviation along it, µm.
        dR_um: float
        #: Its part in X, µm.
        dX_um: float
        #: Its part in Y, µm.
        dY_um: float
        #: Its standard uncertainty, µm.
        u_um: float

    class EccentricityEntry(Record):
        """The dial gauge on the turning ball."""
        #: Ball − spindle in x and y, mm.
        offset_mm: List[float]
        #: Its standard uncertainties, mm.
        u_offset_mm: List[float]
        #: Run-out of the ball, µm.
        runout_um: float
        #: Root mean square of the residual, µm.
        left_rms_um: float

    class ZDatumEntry(Record):
        """The length of the probe."""
        #: Height of the ring, mm.
        ring_top_mm: float
        #: Length of the probe, mm.
        length_mm: float
        #: Its standard uncertainty, mm.
        u_length_mm: float
        #: Range of the triggers, µm.
        range_um: float

    class XyDatum(Record):
        """What a control takes over from four hits."""
        #: Ball − spindle in x and y, mm.
        offset_mm: List[float]
        #: The effective diameters of the ball in x and y, less the pre-travel, mm.
        ball_diameter_mm: List[float]

    class StylusEntry(Record):
        """The results of one stylus."""
        #: Its name.
        stylus: str
        #: Range of the radii as measured, µm.
        range_before_um: float
        #: The same with only the offset corrected, µm.
        range_offset_only_um: float
        #: The same corrected, µm.
        range_after_um: float
        #: The same corrected, directions held out, µm.
        range_held_out_um: float
        #: Root mean square as measured, µm.
        rms_before_um: float
        #: The same corrected, µm.
        rms_after_um: float
        #: The same corrected, directions held out, µm.
        rms_held_out_um: float
        #: The least and the greatest measured radius, mm.
        radius_before_mm: List[float]
        #: Ball − spindle with the spindle at 0, mm; null if not observable.
        offset_mm: Optional[List[float]]
        #: Its standard uncertainties, mm.
        u_offset_mm: Optional[List[float]]
        #: Centre of the gauge, mm.
        centre_mm: List[float]
        #: Whether that is stated.
        centre_known: bool
        #: By how much an offset from four hits alone differs, µm.
        four_hit_bias_um: List[float]
        #: The model of the pre-travel: `fourier` or `spline`.
        model: str
        #: Its highest harmonic, or its number of knots.
        size: int
        #: Harmonics of the pre-travel; the first is part of the offset.
        harmonics: List[IdentifyProbeDocument.HarmonicEntry]
        #: The sizes of model that were tried.
        scores: List[IdentifyProbeDocument.ProbeScoreEntry]
        #: Number of hits.
        hits: int
        #: Standard deviation of one hit, µm.
        s_um: float
        #: Degrees of freedom of the fit.
        degrees_of_freedom: int
        #: Factor from u to U (95 %). Unit: 1.
        coverage_factor: float
        #: Orientations of the spindle, degrees.
        orientations_deg: List[float]
        #: Widest gap between directions, degrees.
        widest_gap_deg: float
        #: Repeated hits; null if there are none.
        repeatability: Optional[IdentifyProbeDocument.RepeatsEntry]
        #: Form error after ISO 230-10; null if the hits do not allow it.
        iso230_10: Optional[IdentifyProbeDocument.FormEntry]
        #: Fresh hits that were not used in the fit; null if there are none.
        check: Optional[IdentifyProbeDocument.FreshCheckEntry]
        #: Orientation of the spindle for the table below, degrees.
        table_orientation_deg: float
        #: Deviations by direction of motion.
        table: List[IdentifyProbeDocument.DirectionEntry]
        #: Deviation of each hit as measured, µm.
        deviations_um: List[float]
        #: Residual of each hit, µm.
        left_um: List[float]
        #: Residual of each hit, its direction held out, µm.
        held_out_um: List[float]


class IdentifyProbeProgramsDocument(Record):
    """`trueaxis/identify-probe-programs/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/identify-probe-programs/1"]
    #: Programs, subprograms and masks.
    files: List[IdentifyProbeProgramsDocument.ProbeProgramEntry]
    #: The table of corrections that the control applies; null: hits as they are.
    table: Optional[IdentifyProbeProgramsDocument.TableEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class ProbeProgramEntry(Record):
        """One file."""
        #: Its name in the folder.
        file: str
        #: What it is for.
        purpose: str
        #: How many hits it makes; null: it is no program of its own.
        hits: Optional[int]
        #: How far its stations, read back, lie from those that are wanted, µm; null: it is not run alone.
        off_stations_um: Optional[float]

    class TableEntry(Record):
        """The table inside the control."""
        #: Directions.
        directions: int
        #: Greatest less smallest correction, µm.
        range_um: float
        #: What the straight lines between the directions leave at most of the calibration, µm.
        interpolation_um: float
        #: The largest standard uncertainty of a correction, µm.
        u_um: float
        #: The length of the probe that is subtracted on the plane face, mm; null: it is not known.
        length_mm: Optional[float]


class IdentifyRtcpDocument(Record):
    """An RTCP calibration."""
    #: Which document this is.
    schema: Literal["trueaxis/identify-rtcp/1"]
    #: The name of the study.
    name: str
    #: The name of the machine.
    machine: str
    #: Which rotary axes carry the tool and which the workpiece.
    topology: str
    #: The offsets of the rotary axes in chain order.
    offsets: List[IdentifyRtcpDocument.OffsetEntry]
    #: Whether the directions of the rotary axes were unknowns beside the offsets.
    angles_found: bool
    #: The angle errors of the rotary axes.
    angles: List[IdentifyRtcpDocument.AngleEntry]
    #: What the segments of a path with tool-centre point keep; null if the file has no `[segments]`.
    segments: Optional[IdentifyRtcpDocument.SegmentsEntry]
    #: The RTCP screen of the i5 control, field by field; empty for other controls.
    screen: List[IdentifyRtcpDocument.ScreenEntry]
    #: The control whose numbers follow; null if none is stated.
    control: Optional[str]
    #: The numbers of the control.
    numbers: List[IdentifyRtcpDocument.NumberEntry]
    #: Offsets that no number of the control takes in.
    without_number: List[str]
    #: Combinations of offsets that change no reading.
    unobservable: List[IdentifyRtcpDocument.Unseen]
    #: How many numbers were read.
    readings: int
    #: χ² of the readings. Unit: 1.
    chi_square: float
    #: Its degrees of freedom.
    degrees_of_freedom: int
    #: By how much the uncertainties are enlarged, 1 or more. Unit: 1.
    birge: float
    #: Root mean square of the residual, µm.
    rms_residual_um: float
    #: The reading that fits worst.
    worst_reading: Optional[IdentifyRtcpDocument.WorstEntry]
    #: Wrong signs that would explain a bad fit.
    suspicions: List[str]
    #: The tip before and after; null if not all offsets are known.
    forecast: Optional[IdentifyRtcpDocument.ForecastEntry]
    #: The result in one sentence.
    verdict: str
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class OffsetEntry(Record):
        """One offset of a rotary axis."""
        #: Its ISO 230-1 name.
        name: str
        #: The same in words.
        words: str
        #: True − machine file, µm; null if no reading determines it.
        value_um: Optional[float]
        #: Its standard uncertainty, µm.
        u_um: Optional[float]

    class AngleEntry(Record):
        """One angle error of a rotary axis."""
        #: Its ISO 230-1 name.
        name: str
        #: The same in words.
        words: str
        #: Its value, µrad; null where it was not asked for or is not observable.
        value_urad: Optional[float]
        #: Its expanded uncertainty (k = 2), µrad.
        U_urad: Optional[float]
        #: Whether these readings determine it.
        observable: bool
        #: The expanded uncertainty (k = 2) that these readings give by their stated noise, µrad; null: none.
        U_expected_urad: Optional[float]
        #: Which further reading would determine it; null where these do.
        further_reading: Optional[str]

    class SegmentsEntry(Record):
        """What the segments of a path keep."""
        #: The largest chord error, µm.
        chord_error_um: float
        #: The largest distance of the path from a rotary axis, mm.
        distance_mm: float
        #: The largest step of one rotary axis while the tip stands still, degrees.
        largest_step_deg: float
        #: By how much the rotary axes together turn for each mm where the path turns most, deg/mm. Unit: deg/mm.
        sharpest_deg_per_mm: Optional[float]
        #: The longest segment there, mm.
        longest_segment_mm: Optional[float]
        #: The shortest segment of the control, mm, if stated.
        shortest_segment_mm: Optional[float]
        #: The turning that it allows, deg/mm. Unit: deg/mm.
        shortest_allows_deg_per_mm: Optional[float]
        #: The first segment of the control, mm, if stated.
        first_segment_mm: Optional[float]
        #: The turning that it allows, deg/mm. Unit: deg/mm.
        first_allows_deg_per_mm: Optional[float]

    class ScreenEntry(Record):
        """One field of the RTCP screen."""
        #: Its name in English.
        name: str
        #: Its name as it is printed.
        printed: str
        #: Its unit; `--` where the screen states none.
        unit: str
        #: What the picture of the paper shows.
        picture: str
        #: What to enter; null where neither paper nor readings determine it.
        enter: Optional[str]
        #: Why, or why not.
        words: str

    class NumberEntry(Record):
        """One number of the control."""
        #: Its name at the control.
        name: str
        #: What it means.
        words: str
        #: As it is entered today, mm.
        old_mm: float
        #: As it is to be entered, mm; null if no reading determines it.
        new_mm: Optional[float]
        #: Standard uncertainty of the new one, µm.
        u_um: Optional[float]
        #: Whether the offsets change it at all.
        changes: bool

    class Unseen(Record):
        """A combination of offsets that changes no reading."""
        #: As a sum.
        combination: str
        #: What that means.
        words: str

    class WorstEntry(Record):
        """The reading that fits worst."""
        #: File of the reading.
        file: str
        #: Its line there.
        line: int
        #: Its direction: x, y or z.
        channel: str
        #: Reading − model, µm.
        residual_um: float
        #: The same in its standard uncertainty. Unit: 1.
        standardised: float
        #: Whether that is more than chance.
        is_outlier: bool

    class ForecastEntry(Record):
        """The tip over all poses, before and after."""
        #: How many poses.
        poses: int
        #: With the old numbers.
        before: IdentifyRtcpDocument.StraysEntry
        #: With the new numbers as entered, if the centres are right.
        after: IdentifyRtcpDocument.StraysEntry
        #: Expanded uncertainty (k = 2) at the worst pose, µm.
        U_after_um: float
        #: The root mean square to be expected, µm.
        expected_rms_um: float

    class StraysEntry(Record):
        """How far the tip strays."""
        #: The longest deviation, µm.
        worst_um: float
        #: The root mean square of all, µm.
        rms_um: float
        #: The rotary axes at the longest deviation, degrees.
        at_deg: Mapping[str, float]


class IdentifyRtcpProgramsDocument(Record):
    """`trueaxis/identify-rtcp-programs/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/identify-rtcp-programs/1"]
    #: The programs.
    programs: List[IdentifyRtcpProgramsDocument.ProgramEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class ProgramEntry(Record):
        """One program."""
        #: Its file in the folder.
        file: str
        #: The set of readings.
        set: str
        #: How far its poses, read back, lie from those of the set, µm.
        off_poses_um: float


class IdentifySurfaceDocument(Record):
    """Deviations of a surface from the hits of a probing program."""
    #: Which document this is.
    schema: Literal["trueaxis/identify-surface/1"]
    #: Name of the study.
    name: str
    #: Whether a virtual machine made the hits.
    virtual: bool
    #: The number of the probe in the control.
    tool: int
    #: The stylus of the calibration.
    stylus: str
    #: Number of hits in the log.
    hits: int
    #: Number of hits that were planned.
    planned: int
    #: The touch at the end less the first one at the same point, µm; null if there is none.
    drift_um: Optional[float]
    #: Points without a hit.
    lost: List[int]
    #: The points with their deviations.
    points: List[IdentifySurfaceDocument.DeviationEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class DeviationEntry(Record):
        """A point of the surface."""
        #: Its number in the table of points.
        point: int
        #: The nominal point, workpiece frame, mm.
        point_mm: List[float]
        #: The normal there, out of the material. Unit: 1.
        normal: List[float]
        #: Along the normal, positive where there is more material, µm.
        deviation_um: float
        #: Its expanded uncertainty (k = 2), µm.
        U_um: float
        #: With the nominal machine and the ball radius alone, µm.
        as_read_um: float
        #: What the errors of the machine did, µm.
        by_machine_um: float
        #: What offset and pre-travel of the probe did, µm.
        by_probe_um: float
        #: What the drift did, µm.
        by_drift_um: float
        #: Standard uncertainty: one trigger, µm.
        u_repeatability_um: float
        #: Standard uncertainty: calibration of the probe, µm.
        u_calibration_um: float
        #: Standard uncertainty: length of the probe, µm.
        u_length_um: float
        #: Standard uncertainty: errors of the machine, µm.
        u_machine_um: float
        #: Standard uncertainty: drift, µm.
        u_drift_um: float
        #: Its line in the log.
        line: int


class IdentifyTablesDocument(Record):
    """Error tables of a machine."""
    #: Which document this is.
    schema: Literal["trueaxis/identify-tables/1"]
    #: The name of the study.
    name: str
    #: The tables of error motions, axis by axis.
    tables: List[IdentifyTablesDocument.FoundTable]
    #: The squarenesses from circles.
    squarenesses: List[IdentifyTablesDocument.FoundSquareness]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class FoundTable(Record):
        """The table of one error motion; of the body, as in the machine file."""
        #: The error by its name of ISO 230-1.
        error: str
        #: `um` or `urad`: the unit of its values.
        unit: str
        #: How many runs in each direction.
        runs: int
        #: Standard deviation of a single reading, µm or µrad; null where each target was read once. Unit: that of `unit`.
        scatter: Optional[float]
        #: What the set-up of the instrument hides, and was subtracted.
        removed: str
        #: What the angles of the axis did to the readings over the arm of the optics.
        arms: List[IdentifyTablesDocument.ArmEntry]
        #: Largest − least of the mean of both directions, µm or µrad. Unit: that of `unit`.
        range: float
        #: How far the instrument would read otherwise on the new machine, µm or µrad. Unit: that of `unit`.
        read_back: float
        #: Its rows.
        rows: List[IdentifyTablesDocument.FoundRow]

    class ArmEntry(Record):
        """What an angle did over the arm."""
        #: The angular error.
        error: str
        #: At most, µm.
        most_um: float

    class FoundRow(Record):
        """A row of a table."""
        #: The position. Unit: mm or deg.
        position: float
        #: Reached upwards, µm or µrad. Unit: that of `unit`.
        up: float
        #: Reached downwards, µm or µrad; equal to `up` where one direction was read. Unit: that of `unit`.
        down: float
        #: Standard uncertainty, µm or µrad. Unit: that of `unit`.
        u: float

    class FoundSquareness(Record):
        """A squareness."""
        #: The location error that states it.
        error: str
        #: Its value, µrad.
        value_urad: float
        #: Its standard uncertainty, µrad.
        u_urad: float
        #: The two axes.
        axes: List[str]
        #: The angle by which the axes are closer than 90°, as read, µrad.
        read_urad: float
        #: The same on the machine with its new tables and its old location error, µrad.
        before_urad: float
        #: The first axis longer than the second over the diameter, read − tables, µm.
        scale_difference_um: float


class IdentifyThermalDocument(Record):
    """A thermal model of one error, from logs of temperatures and displacements."""
    #: Which document this is.
    schema: Literal["trueaxis/identify/1"]
    #: Which form of it: `thermal`.
    what: Literal["thermal"]
    #: Name of the study.
    name: str
    #: The error, such as `EZ0t`.
    error: str
    #: Where the displacement is zero: `cycle`, `start` or `common`.
    zero: str
    #: `model` or `refused`.
    verdict: str
    #: Why the model is refused; null if it is not.
    refusal: Optional[str]
    #: Share of the mean square drift of held-out cycles that the model explains, at most 1. Unit: 1.
    explained: float
    #: Root mean square without a model, µm.
    no_model_um: float
    #: Root mean square of the residual on the rows of the fit, µm.
    in_sample_um: float
    #: The same with single rows held out, µm.
    row_wise_um: float
    #: The same with whole cycles held out, µm.
    held_out_um: float
    #: The same, counted from the first row of each cycle, µm.
    held_out_since_start_um: float
    #: Standard uncertainty of one reading, µm.
    repeatability_um: float
    #: Whether it is stated; if not, it comes from neighbouring readings.
    repeatability_stated: bool
    #: Number of terms of the chosen model.
    chosen_terms: int
    #: The coefficients of the chosen model.
    coefficients: List[IdentifyThermalDocument.CoefficientEntry]
    #: Correlations of the coefficients, −1 to 1, row by row. Unit: 1.
    correlation: List[List[float]]
    #: The displacement where all sensors read the reference, µm; null if the zero is free.
    intercept_um: Optional[float]
    #: Where the model is zero, °C.
    reference_celsius: float
    #: The models tried, from no term on.
    scores: List[IdentifyThermalDocument.ThermalScoreEntry]
    #: The model of all terms at once.
    all_terms: IdentifyThermalDocument.ThermalScoreEntry
    #: The cycles.
    cycles: List[IdentifyThermalDocument.CycleEntry]
    #: The lines for the machine file; null if there are none.
    machine_file: Optional[str]
    #: Why there are no such lines; else null.
    no_machine_file_because: Optional[str]
    #: What to observe when the model is used.
    warnings: List[str]
    #: How later logs agree with it; null without later logs.
    later: Optional[IdentifyThermalDocument.ScoringEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class CoefficientEntry(Record):
        """A coefficient."""
        #: The sensor.
        sensor: str
        #: Time constant of its lag, s; null without lag.
        lag_s: Optional[float]
        #: The coefficient, µm/K.
        um_per_k: float
        #: Its standard uncertainty, µm/K.
        u_um_per_k: float
        #: The least and the greatest temperature in the logs, °C.
        range_celsius: List[float]

    class ThermalScoreEntry(Record):
        """How well a model of some terms does."""
        #: Its terms.
        terms: List[IdentifyThermalDocument.TermEntry]
        #: Root mean square of the residual on the rows of the fit, µm.
        in_sample_um: float
        #: The same with single rows held out, µm.
        row_wise_um: float
        #: The same with whole cycles held out, µm.
        held_out_um: float
        #: Its square, µm².
        held_out_um2: float
        #: Standard uncertainty of the square, µm².
        u_held_out_um2: float
        #: Root mean square of each cycle, held out, µm.
        by_cycle_um: List[float]
        #: How many times the same terms were chosen with one cycle held out.
        chosen_again: int
        #: Condition number of the columns; null if they are linearly dependent. Unit: 1.
        condition: Optional[float]

    class TermEntry(Record):
        """A term of a model."""
        #: The sensor.
        sensor: str
        #: Time constant of its lag, s; null without lag.
        lag_s: Optional[float]

    class CycleEntry(Record):
        """A cycle of the logs."""
        #: Its name.
        name: str
        #: Number of its rows.
        rows: int
        #: Root mean square without a model, µm.
        no_model_um: float
        #: Root mean square of the residual, predicted without this cycle, µm.
        held_out_um: float

    class ScoringEntry(Record):
        """How later logs agree with the model."""
        #: `as promised` or `worse than promised`.
        verdict: str
        #: What the model left of whole cycles that it had not seen, rms, µm.
        promised_um: float
        #: Expanded uncertainty of a row within the pattern of the sensors, 95.45 %, µm.
        promised_u_um: float
        #: The factor of U (Student's t). Unit: 1.
        coverage_factor: float
        #: Degrees of freedom of the factor: cycles less one.
        degrees_of_freedom: int
        #: A row with a larger squared distance is outside the pattern. Unit: 1.
        row_limit: float
        #: A log with a larger mean of it is outside the pattern. Unit: 1.
        log_limit: float
        #: The later logs.
        logs: List[IdentifyThermalDocument.ScoredLogEntry]

    class ScoredLogEntry(Record):
        """A later log."""
        #: Its name.
        name: str
        #: `as promised` or `worse than promised`.
        verdict: str
        #: Number of its rows.
        rows: int
        #: Of the displacement without a model, rms, µm.
        no_model_um: float
        #: Of the residual after its zero is removed, rms, µm.
        left_um: float
        #: The largest residual with its sign, µm.
        largest_um: float
        #: Of the expanded uncertainty of the rows, which grows outside the pattern, rms, µm.
        u_um: float
        #: Share of the rows whose residual is within their U. Unit: 1.
        within_u: float
        #: Whether the sensors moved as in the logs of the model: `inside`, `partly outside` or `outside`.
        pattern: str
        #: Rows outside the pattern.
        rows_outside: int
        #: Mean squared distance of the rows from the pattern (Mahalanobis). Unit: 1.
        mean_distance: float
        #: How much warmer all sensors together are than in the mean of the logs of the model, K.
        warmer_k: float
        #: Logs of the same pattern are within this, K; null if one zero holds for all logs.
        warmer_limit_k: Optional[float]
        #: Squared distance of each row. Unit: 1.
        distances: List[float]
        #: Expanded uncertainty of each row, µm.
        row_u_um: List[float]
        #: Residual of each row, µm.
        row_left_um: List[float]
        #: Sensors beyond their range.
        sensors_outside: List[IdentifyThermalDocument.SensorOutsideEntry]
        #: Sensors that are not where the others say, in the farthest row.
        combinations: List[IdentifyThermalDocument.CombinationEntry]

    class SensorOutsideEntry(Record):
        """A sensor beyond its range."""
        #: The sensor.
        sensor: str
        #: Here, °C.
        range_celsius: List[float]
        #: In the logs of the model, °C.
        logged_celsius: List[float]
        #: From its zero, K.
        moved_k: List[float]
        #: From its zero in the logs of the model, K.
        logged_moved_k: List[float]

    class CombinationEntry(Record):
        """A sensor that is not where the others say."""
        #: The sensor.
        sensor: str
        #: Time constant of its lag, s; null without lag.
        lag_s: Optional[float]
        #: Number of the row, from 1.
        row: int
        #: How far it is from what the others say, K.
        off_k: float
        #: Standard deviation of that in the logs of the model, K.
        usual_k: float


class IdentifyToolsDocument(Record):
    """Tools as they were measured."""
    #: Which document this is.
    schema: Literal["trueaxis/identify-tools/1"]
    #: Whether a virtual machine wrote the log.
    is_virtual: bool
    #: The tools in the order in which they were measured.
    tools: List[IdentifyToolsDocument.MeasuredToolEntry]
    #: How far spindle and setter have drifted since the face was calibrated, µm; null without a gauge.
    drift_um: Optional[float]
    #: Its expanded uncertainty (k = 2), µm.
    U_drift_um: Optional[float]
    #: What the uncertainties do not cover.
    missing: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class MeasuredToolEntry(Record):
        """A tool as it was measured."""
        #: Its number.
        tool: int
        #: Its name.
        name: str
        #: `fit`, `not decided`, `worn` or `broken`.
        state: str
        #: Its length, mm.
        length_mm: float
        #: Its expanded uncertainty (k = 2), µm.
        U_length_um: float
        #: Measured − nominal length, µm.
        length_off_um: float
        #: Its diameter, mm; null if it was not measured.
        diameter_mm: Optional[float]
        #: Its expanded uncertainty (k = 2), µm.
        U_diameter_um: Optional[float]
        #: What stands against it.
        faults: List[str]
        #: What cannot be decided.
        doubts: List[str]


class MeasureDocument(Record):
    """The readings of a virtual machine."""
    #: Which document this is.
    schema: Literal["trueaxis/measure/1"]
    #: Name of the campaign.
    name: str
    #: Name of the machine.
    machine: str
    #: Seed of the random numbers.
    seed: int
    #: Duration of the measurement, s.
    time_s: float
    #: Number of readings.
    readings: int
    #: Number of readings that were lost.
    lost: int
    #: The instruments of the campaign.
    instruments: List[MeasureDocument.InstrumentEntry]
    #: Every channel of every instrument on every path.
    channels: List[MeasureDocument.ChannelEntry]
    #: The files that were written.
    files: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class InstrumentEntry(Record):
        """An instrument."""
        #: Its name in the campaign.
        name: str
        #: What kind of instrument it is.
        kind: str
        #: Number of its readings.
        readings: int

    class ChannelEntry(Record):
        """Reading less nominal reading of one channel on one path."""
        #: The path.
        path: str
        #: The instrument.
        instrument: str
        #: The channel.
        channel: str
        #: Number of readings.
        count: int
        #: Row of the largest deviation, from 0.
        largest_row: int


class MeasurePartDocument(Record):
    """A test piece that was cut and measured virtually."""
    #: Which document this is.
    schema: Literal["trueaxis/measure-part/1"]
    #: The name of the study.
    name: str
    #: The random seed.
    seed: int
    #: Whether the errors of the machine were drawn within their uncertainties.
    drawn: bool
    #: Standard uncertainty of a point along the normal, mm.
    point_u_mm: float
    #: The true indices of the part, in the order of the test piece.
    indices: List[MeasurePartDocument.TrueIndexEntry]
    #: The points.
    points: List[MeasurePartDocument.PointEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class TrueIndexEntry(Record):
        """A true index of a virtual part."""
        #: Its key.
        index: str
        #: Its value without the noise of the points, mm.
        value_mm: float

    class PointEntry(Record):
        """A point of a virtual part."""
        #: The number of its section, from 1 at the base.
        section: int
        #: The point in the frame of the datum, mm.
        place_mm: List[float]


class PartDocument(Record):
    """A part file or a draft of one: `trueaxis/part/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/part/1"]
    #: The name of the part; null for a draft.
    name: Optional[str]
    #: The features of a part file.
    features: List[PartDocument.PartFeatureEntry]
    #: Its characteristics.
    characteristics: List[PartDocument.PartCharacteristicEntry]
    #: The draft of a QIF file; null for a part file.
    draft: Optional[PartDocument.DraftEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class PartFeatureEntry(Record):
        """A feature of a part file."""
        #: Its name.
        name: str
        #: `plane`, `cylinder`, `cone`, `sphere`, `torus`, `slot`, `tongue`, `thread`, `points` or `programmed surface`.
        shape: str
        #: Its letter as a datum.
        datum: Optional[str]
        #: How many points are checked; of a surface of the program, lines of sight.
        points: int

    class PartCharacteristicEntry(Record):
        """A characteristic of a part file."""
        #: Its name.
        name: str
        #: What is asked, such as `flatness`.
        kind: str
        #: Of which feature or pattern.
        feature: str
        #: To which features, the first datum first.
        datums: List[str]
        #: How far its zone reaches beyond the end of the axis, below 0 beyond its beginning; absent without a projected zone, mm. May be absent.
        projected_mm: Optional[float]
        #: The least value allowed; null for a zone, mm.
        low_mm: Optional[float]
        #: The largest value allowed, mm.
        high_mm: float

    class DraftEntry(Record):
        """A draft of a part file."""
        #: The text of the part file.
        text: str
        #: How many features it has.
        features: int
        #: How many characteristics.
        characteristics: int
        #: How many values the file does not state; they are written as `"?"`.
        unknown: int
        #: What of the QIF file is not in it.
        left_out: List[PartDocument.LeftOutEntry]

    class LeftOutEntry(Record):
        """Something that is not in a draft."""
        #: Its id in the QIF file.
        id: str
        #: What it is.
        what: str
        #: Why it is not in the draft.
        reason: str
        #: Its line in the QIF file.
        line: int


class PlanDocument(Record):
    """What a campaign will show before anybody measures."""
    #: Which document this is.
    schema: Literal["trueaxis/plan/1"]
    #: Name of the campaign.
    name: str
    #: Name of the machine.
    machine: str
    #: The kinematic chain of the machine.
    chain: str
    #: The paths and their programs.
    paths: List[PlanDocument.PathEntry]
    #: What each stage will determine; empty if the campaign has none.
    stages: List[PlanDocument.PlannedStageEntry]
    #: The uncertainty to expect of each unknown.
    expected: List[PlanDocument.ExpectedEntry]
    #: Combinations of unknowns that change no reading.
    unobservable: List[PlanDocument.Unobservable]
    #: Number of combinations of unknowns that are observable.
    rank: int
    #: Condition number of the design matrix. Unit: 1.
    condition: float
    #: The choice of poses; null if none was asked for.
    chosen: Optional[PlanDocument.ChosenEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class PathEntry(Record):
        """A path and its program."""
        #: Its name.
        name: str
        #: Number of stations.
        stations: int
        #: Feed if it is read while moving, mm/min; else null.
        feed_mm_per_min: Optional[float]
        #: Dwell at each station, s.
        dwell_s: float
        #: Channels of the instrument.
        channels: List[str]
        #: Unit of the readings below: `um` or `urad`.
        unit: str
        #: The largest reading that 10 µm or 10 µrad of each error causes.
        seen_of_10_um_or_urad: List[PlanDocument.SeenEntry]
        #: The check of its program, or why there is none.
        program: Any

    class SeenEntry(Record):
        """The readings that an error causes."""
        #: The error.
        error: str
        #: The largest reading of each channel. Unit: that of the path.
        largest: List[float]

    class PlannedStageEntry(Record):
        """A stage of a plan for programs."""
        #: Its name.
        name: str
        #: The uncertainty of each unknown after it.
        expected: List[PlanDocument.PlannedValue]

    class PlannedValue(Record):
        """What is expected of an unknown after a stage."""
        #: Its name.
        name: str
        #: `um`, `urad`, `ms` or `um/m`.
        unit: str
        #: Expanded uncertainty (k = 2); null if it is not known then. Unit: that of `unit`.
        expanded_k2: Optional[float]

    class ExpectedEntry(Record):
        """The uncertainty to expect of an unknown."""
        #: Its name.
        name: str
        #: `um`, `urad`, or `um/m` for a scale.
        unit: str
        #: Standard uncertainty; null if not observable. Unit: that of `unit`.
        u: Optional[float]
        #: Expanded uncertainty (k = 2); null if not observable. Unit: that of `unit`.
        expanded_k2: Optional[float]

    class Unobservable(Record):
        """A combination of unknowns that changes no reading."""
        #: As a sum.
        combination: str
        #: In words.
        words: str
        #: A set-up that makes it observable; null if none of those tried does.
        resolve_with: Optional[str]

    class ChosenEntry(Record):
        """The chosen poses."""
        #: Number of poses.
        poses: int
        #: Number of poses to choose from.
        candidates: int
        #: Candidates left out because of collisions or travel limits.
        blocked: int
        #: Number of readings.
        readings: int
        #: Duration of the measurement, s.
        time_s: float
        #: The criterion at the start and after every exchange. Unit: 1.
        criterion: List[float]
        #: The uncertainties to expect.
        expected: List[PlanDocument.ExpectedEntry]
        #: A plain grid of as many poses, to compare with; null if there is none.
        grid: Optional[PlanDocument.GridEntry]

    class GridEntry(Record):
        """A plain grid of poses."""
        #: Number of poses.
        poses: int
        #: The uncertainties to expect.
        expected: List[PlanDocument.ExpectedEntry]


class PlanProbeSurfaceDocument(Record):
    """A probing path over a surface."""
    #: Which document this is.
    schema: Literal["trueaxis/plan-probe-surface/1"]
    #: Name of the study.
    name: str
    #: Number of points that were spread over the surface.
    asked: int
    #: The points that the probe touches, in their order.
    points: List[PlanProbeSurfaceDocument.PointEntry]
    #: Least distance of two points, mm.
    spacing_mm: float
    #: How long the program runs, s.
    duration_s: float
    #: Whether the program has neither errors nor critical issues.
    sound: bool
    #: Errors of the program itself.
    errors: List[str]
    #: Critical issues, such as collisions.
    troubles: List[str]
    #: Minor issues, such as lost time.
    notes: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class PointEntry(Record):
        """A point that the probe touches."""
        #: Where it is, workpiece frame, mm.
        point_mm: List[float]
        #: The normal of the surface there, out of the material. Unit: 1.
        normal: List[float]
        #: Its line in the file of the surface.
        line: int


class PlanToolSettingDocument(Record):
    """Touches at a tool setter."""
    #: Which document this is.
    schema: Literal["trueaxis/plan-tool-setting/1"]
    #: The name of the machine.
    machine: str
    #: The touches in their order.
    touches: List[PlanToolSettingDocument.TouchEntry]
    #: How long the program runs, s.
    duration_s: float
    #: Whether the program has neither errors nor critical issues.
    sound: bool
    #: Errors of the program itself.
    errors: List[str]
    #: Critical issues, such as collisions.
    troubles: List[str]
    #: Minor issues, such as lost time.
    notes: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class TouchEntry(Record):
        """One touch."""
        #: The tool.
        tool: int
        #: What it measures: `length`, `plus` or `minus` (the sides of the diameter).
        of: str
        #: X, Y and Z where the nominal tool touches, mm.
        expected_mm: List[float]
        #: X, Y and Z where the touch ends at the latest, mm.
        beyond_mm: List[float]


class PoseDocument(Record):
    """The tool at one position of the axes."""
    #: Which document this is.
    schema: Literal["trueaxis/pose/1"]
    #: As the control commands it.
    nominal: PoseDocument.ToolPoseEntry
    #: As the machine with its errors moves it.
    actual: PoseDocument.ToolPoseEntry
    #: Actual − nominal.
    deviation: PoseDocument.DeviationEntry
    #: The deviation under each error alone.
    budget: List[PoseDocument.ShareEntry]
    #: Nominal and actual place of every body; absent unless it was asked for. May be absent.
    bodies: Optional[List[PoseDocument.BodyEntry]]
    #: By the name of the cause: `geometric`, `scale`, `structure`, `workpiece`. May be absent.
    split: Mapping[str, PoseDocument.TipEntry]
    #: Of the machine without the growth of the workpiece. May be absent.
    machine: PoseDocument.TipEntry
    #: Of all together. May be absent.
    comprehensive: PoseDocument.ComprehensiveEntry
    #: How fast the workpiece takes the temperature of the air; absent where that is not stated. May be absent.
    settling: Optional[PoseDocument.SettlingEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class ToolPoseEntry(Record):
        """A tool in the workpiece frame."""
        #: Its tip, mm.
        tip_mm: List[float]
        #: Its axis from the tip to the spindle, a unit vector. Unit: 1.
        axis: List[float]

    class DeviationEntry(Record):
        """A deviation of the tool."""
        #: Of the tip, µm.
        tip_um: List[float]
        #: Of the axis, µrad.
        axis_urad: List[float]

    class ShareEntry(Record):
        """One error alone."""
        #: The ISO 230-1 name of the error; `EXX(scale)`, `workpiece` and the like for the parts of temperatures.
        error: str
        #: Of the tip, µm.
        tip_um: List[float]
        #: Of the axis, µrad.
        axis_urad: List[float]

    class BodyEntry(Record):
        """A body of the machine."""
        #: Its name.
        body: str
        #: Its nominal place in the machine frame.
        nominal: PoseDocument.PlaceEntry
        #: Its actual place there.
        actual: PoseDocument.PlaceEntry

    class PlaceEntry(Record):
        """The place of a body."""
        #: Its origin, mm.
        origin_mm: List[float]
        #: Its rotation, row by row. Unit: 1.
        rotation: List[List[float]]

    class TipEntry(Record):
        """A deviation of the tip."""
        #: Deviation of the tip, µm.
        tip_um: List[float]

    class ComprehensiveEntry(Record):
        """The deviation of the tip from all causes."""
        #: Deviation of the tip, µm.
        tip_um: List[float]
        #: How it is made up.
        formula: str

    class SettlingEntry(Record):
        """How fast the workpiece takes the temperature of the air."""
        #: Its time constant, s.
        time_constant_s: float
        #: The time until a tenth of a difference remains, s.
        time_to_a_tenth_s: float


class PoseRowsDocument(Record):
    """The tool at many positions of the axes."""
    #: Which document this is.
    schema: Literal["trueaxis/pose/1"]
    #: One object for each row of the input: its columns as they were given, then `tip_x_mm` … `axis_k` (the nominal tool in the workpiece frame), `dev_x_um` … `dev_k_urad` (actual − nominal).
    rows: List[Mapping[str, float]]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]


class PostDocument(Record):
    """An NC program from cutter locations."""
    #: Which document this is.
    schema: Literal["trueaxis/post/1"]
    #: The name of the machine.
    machine: str
    #: The file of the cutter locations.
    file: str
    #: The file of the program.
    program: str
    #: Whether the program was written: not where the verification found it out of tolerance.
    written: bool
    #: Points of the cutter-location file.
    points: int
    #: Strokes of the tool in the file.
    strokes: int
    #: Blocks that move the tool along them.
    blocks: int
    #: Lines of the program.
    lines: int
    #: Blocks that are arcs.
    arcs: int
    #: Holes that the control drills by its own cycle.
    holes: int
    #: How many of them are tapped threads.
    threads: int
    #: How often the tool retracts so that an axis can rewind.
    rewinds: int
    #: How far the tool axis was turned to pass through a pole, degrees.
    pole_deviation_deg: float
    #: The tolerance of the tip, mm.
    tolerance_mm: float
    #: The tolerance of the tool axis, degrees.
    axis_tolerance_deg: float
    #: Words of the file that can change motion, spindle or coolant and are not applied; the exit status is then 1.
    not_applied: int
    #: The program read back and simulated; null if that was not asked for.
    verify: Optional[PostDocument.VerificationEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class VerificationEntry(Record):
        """A program read back and simulated on the nominal machine."""
        #: Whether it is within the tolerances and every axis within its travel.
        within_tolerance: bool
        #: How many blocks were compared at their ends.
        blocks_compared: int
        #: Largest deviation of the tip at the ends of blocks, µm.
        tip_at_blocks_um: PostDocument.LargestEntry
        #: Largest deviation of the tool axis at the ends of blocks, µrad.
        axis_at_blocks_urad: PostDocument.LargestEntry
        #: Largest distance of the tip from the path, µm.
        tip_on_path_um: PostDocument.LargestEntry
        #: Largest angle of the tool axis from the path, degrees.
        axis_on_path_deg: PostDocument.LargestEntry
        #: Largest error of the lead of tapped threads over their depth, µm; 0 without threads, null where one is not tapped.
        lead_um: PostDocument.LargestEntry
        #: Whether an axis leaves its travel.
        axes_beyond_travel: bool

    class LargestEntry(Record):
        """The largest deviation and where it is."""
        #: The value. Unit: that of the key.
        value: float
        #: The line of the program.
        program_line: int
        #: The line of the cutter-location file.
        file_line: int


class PredictDocument(Record):
    """A test piece before it is cut: `trueaxis/predict/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/predict/1"]
    #: The version of TrueAxis.
    version: str
    #: The name of the study.
    study: str
    #: The machine.
    machine: PredictDocument.MachineEntry
    #: The name of the test piece.
    test_piece: str
    #: `pass`, `fail` or `undecided`.
    verdict: str
    #: The indices, those of ISO under `iso`, those of the paper under `paper`, mm.
    indices: Mapping[str, Any]
    #: The tolerances with their verdicts.
    judgements: List[PredictDocument.JudgementEntry]
    #: Where the axes stand when the zero is set, mm and deg.
    setting_command: Mapping[str, float]
    #: The form at each measuring position.
    positions: List[PredictDocument.PositionEntry]
    #: The share of each error in each index, the largest first.
    blame: List[PredictDocument.ShareEntry]
    #: The same with all errors of a body together.
    blame_by_body: List[PredictDocument.ShareEntry]
    #: The same with all location errors and all error motions together.
    blame_by_kind: List[PredictDocument.ShareEntry]
    #: Slopes of the indices by each location error.
    sensitivity: List[PredictDocument.SensitivityEntry]
    #: Single corrections after which the part would pass, the smallest first.
    corrections: List[PredictDocument.CorrectionEntry]
    #: The same part with other setting points and datums.
    variants: List[PredictDocument.VariantEntry]
    #: Axis positions of all tool positions, mm and deg.
    commands: List[Mapping[str, float]]
    #: The Monte Carlo run; null if there was none.
    monte_carlo: Optional[PredictDocument.SamplingEntry]
    #: The log that the temperatures follow; null if there is none.
    temperature_log: Optional[str]
    #: The part at the feed of every cutting condition; absent without `[servo]`. May be absent.
    conditions: List[PredictDocument.ConditionEntry]
    #: What to know of this prediction.
    warnings: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class MachineEntry(Record):
        """The machine."""
        #: Its name.
        name: str
        #: Its chain from the workpiece to the tool.
        chain: str

    class IndexEntry(Record):
        """An index of the whole part."""
        #: Its value. Unit: mm.
        value: float
        #: Its standard uncertainty by linear propagation, mm.
        u_mm: float
        #: From the Monte Carlo run; absent if there was none. May be absent.
        monte_carlo: Optional[PredictDocument.SpreadEntry]

    class SpreadEntry(Record):
        """What the Monte Carlo run gives for an index."""
        #: The mean, mm.
        mean_mm: float
        #: The standard uncertainty, mm.
        u_mm: float
        #: Lower and upper end of the 95 % interval, mm.
        interval_95_mm: List[float]

    class JudgementEntry(Record):
        """A tolerance with its verdict."""
        #: The key of the index.
        index: str
        #: Its value, mm.
        value_mm: float
        #: The tolerance, mm.
        tolerance_mm: float
        #: The expanded uncertainty; null where the rule uses none, mm.
        expanded_mm: Optional[float]
        #: Value divided by tolerance. Unit: 1.
        used_ratio: float
        #: Whether the verdict depends on it.
        decisive: bool
        #: `pass`, `fail` or `undecided`.
        verdict: str

    class PositionEntry(Record):
        """The form at one measuring position."""
        #: Its number, from 1.
        position: int
        #: Its place along the axis of the part in the workpiece frame, mm.
        z_mm: float
        #: Its height above the base, mm.
        height_mm: float
        #: The nominal radius, mm.
        nominal_radius_mm: float
        #: Where the form is given, deg.
        azimuth_deg: List[float]
        #: The error there, positive where material is left, mm.
        e_mm: List[float]

    class PositionIndex(Record):
        """An index at one position."""
        #: Its value. Unit: mm.
        value: float
        #: Its standard uncertainty, mm.
        u_mm: float

    class ShareEntry(Record):
        """The share of an error, or of a group of errors, in an index."""
        #: The ISO 230-1 name, or the name of the group.
        error: str
        #: The key of the index.
        index: str
        #: The index if there were only this error, mm.
        alone_mm: float
        #: The index without this error, mm.
        without_mm: float

    class SensitivityEntry(Record):
        """Slopes of the indices by one location error."""
        #: Its ISO 230-1 name.
        error: str

    class CorrectionEntry(Record):
        """A correction of one location error after which the part would pass."""
        #: Its ISO 230-1 name.
        error: str
        #: The indices after it, mm.
        indices_mm: Mapping[str, float]

    class VariantEntry(Record):
        """The same part with another setting point or datum."""
        #: What is different.
        name: str
        #: The indices, mm.
        indices_mm: Mapping[str, float]

    class SamplingEntry(Record):
        """A Monte Carlo run."""
        #: How many machines were drawn.
        samples: int
        #: The random seed.
        seed: int

    class ConditionEntry(Record):
        """The part at the feed of one cutting condition."""
        #: Its name.
        condition: str
        #: The feed of the tip, mm/min.
        feed_mm_per_min: float
        #: The lowest and the highest speed of the tip that the axes allow, mm/min.
        tip_mm_per_min: List[float]
        #: Index after index.
        indices: List[PredictDocument.ConditionIndexEntry]
        #: `pass`, `fail` or `undecided`.
        verdict: str

    class ConditionIndexEntry(Record):
        """An index at the feed of a cutting condition."""
        #: Its key.
        index: str
        #: Its value, mm.
        value_mm: float
        #: Its standard uncertainty, mm.
        u_mm: float
        #: The part of it that comes from the servo alone, mm.
        u_servo_mm: float
        #: The value less that without following errors, mm.
        added_mm: float
        #: The value with the servo alone, on a machine without errors, mm.
        servo_alone_mm: float


class PredictHolesDocument(Record):
    """Holes before they are made, under each compensation: `trueaxis/predict/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/predict/1"]
    #: The name of the study.
    name: str
    #: The least increment of the control, mm.
    increment_mm: float
    #: The tolerance of the place of a hole; null if none is stated, mm.
    tolerance_mm: Optional[float]
    #: The tolerance of the location diameter, either way; null if none is stated, mm.
    location_tolerance_mm: Optional[float]
    #: The compensation that is applied: `none`, `machine`, `comprehensive`, or `acted`: what a live run has recorded.
    applied: str
    #: Whether all stated tolerances are kept with it; null if none is stated.
    in_tolerance: Optional[bool]
    #: The log that the temperatures follow; null if there is none.
    temperature_log: Optional[str]
    #: The record of what acted; null without one.
    acted_record: Optional[str]
    #: The holes under each compensation.
    sets: List[PredictHolesDocument.SetEntry]
    #: The same at the temperatures of the start, held; null where no log runs.
    sets_at_start: Optional[List[PredictHolesDocument.SetEntry]]
    #: What grows with the temperature though the uncertainty of its coefficient is not stated: u lacks it.
    u_lacks: List[str]
    #: What to know of this prediction.
    warnings: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class SetEntry(Record):
        """The holes under one compensation."""
        #: `none`, `machine`, `comprehensive` or `acted`.
        compensation: str
        #: The largest distance of a hole from its place in X and Y, mm.
        worst_mm: float
        #: Its standard uncertainty, mm.
        u_worst_mm: float
        #: Whether all places are in tolerance; null if none is stated.
        in_tolerance: Optional[bool]
        #: Whether the location diameter is in its tolerance; null if none is stated.
        location_in_tolerance: Optional[bool]
        #: The circle on which the holes are; null for fewer than three.
        location_diameter: Optional[PredictHolesDocument.LocationEntry]
        #: The holes in the order of the study.
        holes: List[PredictHolesDocument.HoleEntry]

    class LocationEntry(Record):
        """The circle of the holes at 20 °C, less the nominal one."""
        #: Its diameter by least squares, µm.
        error_um: float
        #: Standard uncertainty of that, µm.
        u_um: float
        #: Smallest and largest distance of opposite holes; null where the number of holes is odd, µm.
        opposite_um: Optional[List[float]]
        #: Standard uncertainties of these two, µm.
        u_opposite_um: Optional[List[float]]
        #: Where its centre is along X and Y, µm.
        centre_um: List[float]

    class HoleEntry(Record):
        """One hole."""
        #: Where it should be in the workpiece frame, mm.
        nominal_mm: List[float]
        #: Where it is at 20 °C, mm.
        actual_mm: List[float]
        #: The difference, µm.
        error_um: List[float]
        #: Its standard uncertainty, µm.
        u_um: List[float]
        #: What the control adds, in least increments along X, Y, Z.
        compensation_increments: List[int]
        #: When it is made, from the start, s.
        time_s: float


class PredictPartDocument(Record):
    """A part before it is cut, judged by its drawing: `trueaxis/predict/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/predict/1"]
    #: The name of the study.
    name: str
    #: The name of the part.
    part: str
    #: `pass`, `fail`, or `undecided` within the uncertainty.
    outcome: str
    #: The same by the compensated program, the zero where it was set; absent unless it was asked for. May be absent.
    compensated_outcome: Optional[str]
    #: The same with the zero set again by compensated motion. May be absent.
    compensated_zero_set_outcome: Optional[str]
    #: Errors each of whose corrections alone brings all characteristics into tolerance, the best first; empty where they are.
    sufficient: List[str]
    #: Steps of the tools.
    steps: int
    #: Errors of the machine file without a stated uncertainty; they add nothing to `u_mm`.
    errors_without_u: List[str]
    #: The Monte Carlo run; absent if there was none. May be absent.
    monte_carlo: Optional[PredictPartDocument.ManyEntry]
    #: The lines of the drawing, in the order of the part file.
    characteristics: List[PredictPartDocument.CharacteristicEntry]
    #: The features, in the order of the part file.
    features: List[PredictPartDocument.FeatureEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class ManyEntry(Record):
        """A Monte Carlo run for a part."""
        #: How many machines were drawn.
        samples: int
        #: The random seed.
        seed: int
        #: The share of them on which all characteristics are in tolerance. Unit: 1.
        good_ratio: float

    class CharacteristicEntry(Record):
        """One line of the drawing."""
        #: Its name.
        name: str
        #: What is asked, such as `flatness`.
        kind: str
        #: Of which feature or pattern.
        feature: str
        #: The features that are meant: one, or all of the pattern.
        features: List[str]
        #: To which features, the first datum first; empty: to the zero that was set.
        datums: List[str]
        #: How far its zone reaches beyond the end of the axis, below 0 beyond its beginning; absent without a projected zone, mm. May be absent.
        projected_mm: Optional[float]
        #: Its value; of a size the deviation from the nominal one, mm.
        value_mm: float
        #: Standard uncertainty of that, by the stated uncertainties of the machine, mm.
        u_mm: float
        #: By how much the value changes with half of the points, mm.
        points_mm: float
        #: As the measuring machine of the study would find it; absent if the study states none. May be absent.
        measured: Optional[PredictPartDocument.MeasuredEntry]
        #: The value that the program leaves on a machine without errors, mm.
        nominal_mm: float
        #: The least value allowed; null for a zone, mm.
        low_mm: Optional[float]
        #: The largest value allowed, mm.
        high_mm: float
        #: How much of the tolerance is used, 1 at a limit. Unit: 1.
        used_ratio: float
        #: `pass`, `fail` or `undecided`.
        outcome: str
        #: By the compensated program, the zero where it was set; absent unless it was asked for. May be absent.
        compensated: Optional[PredictPartDocument.CompensatedEntry]
        #: The same with the zero set again by compensated motion. May be absent.
        compensated_zero_set: Optional[PredictPartDocument.CompensatedEntry]
        #: From the Monte Carlo run; absent if there was none. May be absent.
        monte_carlo: Optional[PredictPartDocument.DrawnEntry]
        #: The errors that matter most, the largest first.
        errors: List[PredictPartDocument.ErrorEffectEntry]

    class MeasuredEntry(Record):
        """A characteristic as it would be measured."""
        #: The mean of its values, mm.
        mean_mm: float
        #: Standard uncertainty by the scatter of the points, mm.
        u_mm: float

    class CompensatedEntry(Record):
        """A characteristic by the compensated program."""
        #: Its value, mm.
        value_mm: float
        #: `pass`, `fail` or `undecided`, with the u of before.
        outcome: str

    class DrawnEntry(Record):
        """A characteristic in the Monte Carlo run."""
        #: The mean, mm.
        mean_mm: float
        #: The standard uncertainty, mm.
        u_mm: float
        #: Lower and upper end of the 95 % interval, mm.
        interval_95_mm: List[float]
        #: The share of machines on which it is in tolerance. Unit: 1.
        good_ratio: float

    class ErrorEffectEntry(Record):
        """What an error does to a characteristic."""
        #: Its ISO 230-1 name.
        error: str
        #: The value without it, mm.
        without_mm: float

    class FeatureEntry(Record):
        """A feature as it was cut."""
        #: Its name.
        name: str
        #: `plane`, `cylinder`, `cone`, `sphere`, `torus`, `slot`, `tongue`, `thread`, `points` or `programmed surface`.
        shape: str
        #: How many points it has.
        points: int
        #: How far neighbouring points are apart, mm.
        spacing_mm: float
        #: The point with the most material left.
        most: PredictPartDocument.PointEntry
        #: The point with the most material missing, or the least left.
        least: PredictPartDocument.PointEntry
        #: Mean of the deviations, mm.
        mean_mm: float

    class PointEntry(Record):
        """A point of a feature."""
        #: Where it should be in the workpiece frame, mm.
        nominal_mm: List[float]
        #: The deviation along the normal; positive where material is left, mm.
        deviation_mm: float
        #: What the program leaves there on a machine without errors, mm.
        by_program_mm: float
        #: The tool that cut it.
        tool: int
        #: The file of the program, or of a subprogram.
        program: str
        #: Its line.
        line: int
        #: When, from the start of the program, s.
        time_s: float
        #: The errors that displace it most, the largest first.
        errors: List[PredictPartDocument.PointEffectEntry]

    class PointEffectEntry(Record):
        """What an error does to a point."""
        #: Its ISO 230-1 name.
        error: str
        #: How much of the deviation of the point it makes, mm.
        part_mm: float


class SimulateDocument(Record):
    """A simulation of a program on a machine: `trueaxis/simulate/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/simulate/1"]
    #: The version of the program `trueaxis`.
    version: str
    #: The machine.
    machine: SimulateDocument.MachineEntry
    #: The program file.
    program: str
    #: The program and its subprograms; `program` elsewhere is an index into this list.
    programs: List[str]
    #: The control.
    control: str
    #: Whether a set-up was given; without one work offsets and tool lengths are 0.
    set_up_given: bool
    #: The result.
    verdict: SimulateDocument.Verdict
    #: The whole time, s.
    time_s: float
    #: Time of rapid moves, s.
    rapid_s: float
    #: Time of dwells, s.
    dwell_s: float
    #: Path length of the tool tip in the workpiece with feed, mm.
    feed_mm: float
    #: The same of rapid moves, mm.
    rapid_mm: float
    #: How many moves the program makes.
    moves: int
    #: How many points of the path were computed.
    nodes: int
    #: Smallest and largest coordinates of the nominal tool tip with feed, workpiece frame, mm; null if it never moves with feed.
    tip_box_mm: Optional[List[List[float]]]
    #: Every axis by its name, in chain order.
    axes: Mapping[str, SimulateDocument.AxisEntry]
    #: The largest deviations of the actual tool from the nominal one.
    deviation: SimulateDocument.DeviationEntry
    #: The first 1000 reversals of all axes, in order of time.
    reversals: List[SimulateDocument.ReversalEntry]
    #: The issues that were found.
    troubles: List[SimulateDocument.IssueEntry]
    #: How many stretches of issues there are in all: the sum of `stretches`.
    troubles_found: int
    #: How many functions of the program that move the tool or its place are not executed: they are among the diagnostics.
    motion_left_out: int
    #: How many times the program asks for a speed of the spindle or a tool that the machine does not have: they are among the diagnostics.
    beyond_equipment: int
    #: Messages of the program to the operator.
    messages: List[str]
    #: Stops in the program, optional ones not counted.
    stops: int
    #: The tools in the order of their numbers.
    tools: List[SimulateDocument.ToolEntry]
    #: The file that the path was written to; null if none was asked for.
    path_file: Optional[str]
    #: Temperatures during the program; null without a temperature log.
    temperatures: Optional[SimulateDocument.TemperaturesEntry]
    #: What became of the stock; null where it was not cut (`--stock`).
    stock: Optional[SimulateDocument.StockEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class MachineEntry(Record):
        """The machine."""
        #: Its name.
        name: str
        #: Its kinematic chain from workpiece to tool.
        chain: str

    class Verdict(Record):
        """The result in one word and in one sentence."""
        #: How it is coloured.
        standing: Any
        #: `PASS`.
        word: str
        #: What that means; may be empty.
        sentence: str

    class AxisEntry(Record):
        """The motion of one axis."""
        #: Its unit: `mm` or `deg`.
        unit: str
        #: The lowest position; null if the axis does not move. Unit: that of `unit`.
        lowest: Optional[float]
        #: The highest position; null if the axis does not move. Unit: that of `unit`.
        highest: Optional[float]
        #: The distance that it travels. Unit: that of `unit`.
        travelled: Optional[float]
        #: How often it changes its direction.
        reversals: int
        #: Its highest speed, in its unit per second.
        fastest_per_s: Optional[float]
        #: The line of the program where that is.
        fastest_line: int
        #: Its speed limit, in its unit per second; null if the machine file states none.
        velocity_limit_per_s: Optional[float]

    class DeviationEntry(Record):
        """The largest deviations of the actual tool from the nominal one, in the workpiece. Those along feed, normal and binormal have a sign; the others are lengths."""
        #: Tool tip with feed, µm.
        tip_um: SimulateDocument.WorstEntry
        #: Root mean square of the tool tip over all points with feed, µm.
        tip_rms_um: float
        #: Tool tip along the feed, µm.
        feed_um: SimulateDocument.WorstEntry
        #: Tool tip along the normal: across the feed, on the side of the tool axis, µm.
        normal_um: SimulateDocument.WorstEntry
        #: Tool tip along the binormal: across feed and normal, µm.
        binormal_um: SimulateDocument.WorstEntry
        #: Tool axis with feed, µrad.
        axis_urad: SimulateDocument.WorstEntry
        #: Tool tip, rapid moves included, µm.
        tip_with_rapid_um: SimulateDocument.WorstEntry
        #: Tool axis, rapid moves included, µrad.
        axis_with_rapid_urad: SimulateDocument.WorstEntry

    class WorstEntry(Record):
        """A largest value and where it occurs."""
        #: The value. Unit: that of the key.
        value: float
        #: The line.
        line: int
        #: The program, an index into `programs`.
        program: int
        #: The time, s.
        time_s: float

    class ReversalEntry(Record):
        """A reversal of an axis."""
        #: The axis.
        axis: str
        #: Its position. Unit: mm or deg.
        at: float
        #: The line.
        line: int
        #: The program, an index into `programs`.
        program: int
        #: The time, s.
        time_s: float

    class IssueEntry(Record):
        """An issue over a stretch of the path."""
        #: `collision`, `near-miss`, `rapid-in-stock`, `gouged-part`, `over-travel`, `over-speed`, `slowed-down` or `rotary-flip`.
        code: str
        #: Whether part or machine are in danger; other issues cost time only.
        grave: bool
        #: The issue in one sentence.
        text: str
        #: The line where it begins.
        line: int
        #: The program, an index into `programs`.
        program: int
        #: The line where it ends.
        last_line: int
        #: When it begins, s.
        from_s: float
        #: When it ends, s.
        to_s: float
        #: How many points of the path are in it.
        nodes: int
        #: How many stretches it holds: above 1 where there are so many of its kind that the nearest were put together.
        stretches: int

    class ToolEntry(Record):
        """A tool."""
        #: Its number.
        tool: int
        #: How many moves it makes.
        moves: int
        #: How long it moves with feed, s.
        with_feed_s: float
        #: How far its tip moves with feed in the workpiece, mm.
        with_feed_mm: float
        #: What is known of its wear and its life; null if the set-up states nothing.
        state: Optional[SimulateDocument.ToolStateEntry]

    class ToolStateEntry(Record):
        """The state of a tool."""
        #: In one or two words: `fit`, `not decided`, `worn`, `broken` or `life spent`.
        word: str
        #: Measured − nominal length, µm; null if it was not measured.
        length_off_um: Optional[float]
        #: Its expanded uncertainty (k = 2), µm.
        U_length_um: Optional[float]
        #: Measured − nominal radius, µm; null if it was not measured.
        radius_off_um: Optional[float]
        #: Its expanded uncertainty (k = 2), µm.
        U_radius_um: Optional[float]
        #: The life that remains after this program, s; null if it does not count by time.
        life_after_s: Optional[float]
        #: The life that remains after this program, mm; null if it does not count by distance.
        life_after_mm: Optional[float]
        #: The tool that takes its place.
        sister: Optional[int]

    class TemperaturesEntry(Record):
        """Temperatures during the program, and the drift that they cause."""
        #: The file of the log.
        log: str
        #: The time of the log when the program begins, s.
        from_s: float
        #: The time of the log when the program ends, s.
        to_s: float
        #: Every sensor by its name.
        sensors: Mapping[str, SimulateDocument.SensorEntry]
        #: How far the deviation of the tool tip has moved since the start, with feed: the largest value, µm.
        drift_um: SimulateDocument.WorstEntry
        #: The same at the end, µm.
        drift_at_end_um: float
        #: How many points of the path have no known drift, because an error table ends before them.
        drift_unknown_places: int

    class SensorEntry(Record):
        """The range of a temperature sensor."""
        #: The lowest temperature; null without a reading. Unit: °C.
        lowest_degC: Optional[float]
        #: The highest temperature; null without a reading. Unit: °C.
        highest_degC: Optional[float]

    class StockEntry(Record):
        """What became of the stock."""
        #: Distance of the lines that the stock is kept on, mm.
        resolution_mm: float
        #: Volume before the first cut, mm³.
        before_mm3: float
        #: Volume that remains, mm³.
        left_mm3: float
        #: How far the volumes by lines along X, Y and Z differ from their mean, mm³.
        spread_mm3: float
        #: Volume that was removed, mm³.
        removed_mm3: float
        #: With feed in material, s.
        cutting_s: float
        #: With feed in the air, s.
        air_s: float
        #: Volume that was cut from the part of the set-up, mm³; null without a part.
        gouged_mm3: Optional[float]
        #: Volume that remains beside the part, mm³; null without a part.
        excess_mm3: Optional[float]
        #: The first 1000 blocks that move a tool, in the order of programs and lines.
        blocks: List[SimulateDocument.BlockEntry]
        #: How many more there are.
        blocks_left_out: int

    class BlockEntry(Record):
        """What a block took, all its runs together."""
        #: The program, an index into `programs`.
        program: int
        #: The line.
        line: int
        #: Volume that it removed, mm³.
        removed_mm3: float
        #: With feed in material, s.
        cutting_s: float
        #: With feed in the air, s.
        air_s: float


class SolveDocument(Record):
    """Axis positions for one tool pose."""
    #: Which document this is.
    schema: Literal["trueaxis/solve/1"]
    #: All solutions of the nominal machine, the best first.
    solutions: List[SolveDocument.SolutionEntry]
    #: Whether an axis has no effect on the tool pose there.
    singular: bool
    #: The name of that axis, which keeps its angle; null if there is none.
    held_axis: Optional[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class SolutionEntry(Record):
        """One solution."""
        #: The positions of the axes, mm and degrees.
        axes: Mapping[str, float]
        #: Whether all axes are within their travel.
        within_limits: bool
        #: How far the rotary axes turn to get there, degrees.
        rotary_travel_deg: float


class SolvePathDocument(Record):
    """Axis positions for a path of tool poses."""
    #: Which document this is.
    schema: Literal["trueaxis/solve/1"]
    #: One for each pose of the path.
    rows: List[SolvePathDocument.SolveRowEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class SolveRowEntry(Record):
        """The axis positions for one pose of a path."""
        #: The positions of the axes, mm and degrees.
        axes: Mapping[str, float]


class StudyDocument(Record):
    """Many machines on many days: `trueaxis/study/1`."""
    #: Which document this is.
    schema: Literal["trueaxis/study/1"]
    #: The name of the study.
    name: str
    #: Which samples there are.
    design: StudyDocument.DesignEntry
    #: What is varied.
    inputs: List[StudyDocument.InputEntry]
    #: What every machine makes.
    cases: List[StudyDocument.CaseEntry]
    #: What is asked of the machines; null if nothing is.
    requirement: Optional[StudyDocument.RequirementEntry]
    #: `pass`, `fail` or `undecided`: whether it is met, at one combination if there are several; null if nothing is asked.
    outcome: Optional[str]
    #: The combinations of levels of a factorial design; else one.
    combinations: List[StudyDocument.CombinationEntry]
    #: What makes the variance of each output; empty without a sensitivity analysis.
    sensitivities: List[StudyDocument.SensitivityEntry]

    class DesignEntry(Record):
        """Which samples there are."""
        #: `monte-carlo`, `latin-hypercube`, `sobol` or `factorial`.
        kind: str
        #: Machines, of each combination.
        machines: int
        #: Days of each machine.
        days: int
        #: The random seed.
        seed: int
        #: Combinations of levels.
        combinations: int
        #: Rows of the sensitivity analysis.
        sensitivity_rows: int
        #: All samples.
        samples: int

    class InputEntry(Record):
        """One input."""
        #: Its name.
        name: str
        #: The inputs whose effect is found together.
        group: str
        #: `machine`, `day` or `hall`: how often it is drawn.
        per: str
        #: `normal`, `uniform`, `triangular`, `arcsine` or `values`.
        distribution: str
        #: The unit of mean and u: mm, rad, degC, s or 1.
        unit: str
        #: Its mean. Unit: that of `unit`.
        mean: float
        #: Its standard deviation. Unit: that of `unit`.
        u: float

    class CaseEntry(Record):
        """What every machine makes."""
        #: Its name in the study.
        name: str
        #: Its study file.
        study: str
        #: The machine.
        machine: str

    class RequirementEntry(Record):
        """What is asked of the machines."""
        #: The share of machines that hold their tolerances. Unit: 1.
        machines_ratio: float
        #: On this share of days. Unit: 1.
        days_ratio: float

    class CombinationEntry(Record):
        """One combination of levels."""
        #: The value of each factorial input.
        levels: List[StudyDocument.LevelEntry]
        #: The outputs, case after case.
        outputs: List[StudyDocument.OutputEntry]
        #: Machines and parts that hold all tolerances of each case; null for a case without any.
        cases: List[Optional[StudyDocument.GoodEntry]]
        #: Those that hold all of them; null if there are none.
        good: Optional[StudyDocument.GoodEntry]
        #: `pass`, `fail` or `undecided`; null if nothing is asked.
        outcome: Optional[str]

    class LevelEntry(Record):
        """The value of a factorial input."""
        #: The input.
        input: str
        #: Its unit: mm, rad, degC, s or 1.
        unit: str
        #: Its value. Unit: that of `unit`.
        value: float

    class OutputEntry(Record):
        """The spread of one output."""
        #: Its case.
        case: str
        #: Its key.
        key: str
        #: The least value allowed; null without one, mm.
        low_limit_mm: Optional[float]
        #: The largest value allowed; null without one, mm.
        high_limit_mm: Optional[float]
        #: Mean of all machines and days, mm.
        mean_mm: float
        #: Standard deviation; null of a single part, mm.
        u_mm: Optional[float]
        #: 2.5 % quantile, mm.
        low_mm: float
        #: 97.5 % quantile, mm.
        high_mm: float
        #: The smallest value, mm.
        least_mm: float
        #: The largest value, mm.
        largest_mm: float
        #: The share of parts on which it is in tolerance; null without a limit. Unit: 1.
        good_ratio: Optional[float]
        #: Standard deviation from machine to machine; null for one machine or one day, mm.
        machines_u_mm: Optional[float]
        #: From day to day, the same for all machines; null for one machine or one day, mm.
        days_u_mm: Optional[float]
        #: Of a machine on a day alone; null for one machine or one day, mm.
        rest_u_mm: Optional[float]
        #: Where the first cell of the histogram begins, mm.
        histogram_from_mm: float
        #: The width of its cells, mm.
        histogram_width_mm: float
        #: How many values each cell has.
        histogram: List[int]

    class GoodEntry(Record):
        """Machines and parts that hold their tolerances."""
        #: The share of parts. Unit: 1.
        parts_ratio: float
        #: Its standard uncertainty; null where all machines have the same share. Unit: 1.
        u_parts_ratio: Optional[float]
        #: How many machines.
        machines: int
        #: The share of machines. Unit: 1.
        machines_ratio: float
        #: The ends of its interval of 95 %. Unit: 1.
        machines_interval_ratio: List[float]

    class SensitivityEntry(Record):
        """What makes the variance of one output."""
        #: Its case.
        case: str
        #: Its key.
        key: str
        #: The groups of inputs; null if the output does not vary.
        groups: Optional[List[StudyDocument.GroupEntry]]

    class GroupEntry(Record):
        """The indices of Sobol' of one group."""
        #: The group.
        group: str
        #: First index: of the group alone. Unit: 1.
        first_ratio: float
        #: Its standard uncertainty. Unit: 1.
        u_first_ratio: float
        #: Total index: with all interactions. Unit: 1.
        total_ratio: float
        #: Its standard uncertainty. Unit: 1.
        u_total_ratio: float


class TraceDocument(Record):
    """One block of a program through every stage of the simulation."""
    #: Which document this is.
    schema: Literal["trueaxis/trace/1"]
    #: The machine.
    machine: TraceDocument.MachineEntry
    #: The file of the program.
    program: str
    #: The block that was asked for: its number N, else its line.
    block: int
    #: Its line in the program.
    line: int
    #: Its text.
    text: str
    #: How often it is executed; the first time is traced.
    executions: int
    #: What the interpreter of the control makes of it.
    programmed: TraceDocument.ProgrammedEntry
    #: The points into which its path is divided.
    nodes: List[TraceDocument.NodeEntry]
    #: The positions of the axes, mm and degrees. May be absent.
    axes: Mapping[str, float]
    #: The nominal tool in the workpiece frame. May be absent.
    nominal: TraceDocument.ToolPoseEntry
    #: The actual tool there. May be absent.
    actual: TraceDocument.ToolPoseEntry
    #: Actual − nominal. May be absent.
    deviation: TraceDocument.PathDeviationEntry
    #: When the block runs. May be absent.
    time: TraceDocument.TimeEntry
    #: The deviation at its end under each error alone; absent if nothing moves. May be absent.
    budget: Optional[List[TraceDocument.ShareEntry]]
    #: The place of every body at its end; absent if nothing moves. May be absent.
    bodies: Optional[List[TraceDocument.BodyEntry]]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class MachineEntry(Record):
        """A machine by its name."""
        #: Its name.
        name: str
        #: Its kinematic chain from the workpiece to the tool.
        chain: str

    class ProgrammedEntry(Record):
        """A block as the control reads it."""
        #: Its moves.
        moves: List[TraceDocument.MoveEntry]
        #: What else it does, in words.
        events: List[str]
        #: The program frame.
        frame: TraceDocument.FrameEntry
        #: Whether the tip of the tool is programmed (RTCP, TRAORI, TCPM).
        tool_centre: bool
        #: Whether the frame is that of a tilted working plane.
        tilted_plane: bool
        #: How the tool axis is interpolated: `axes`, `great circle` or `cone`.
        orientation: str
        #: The number of the tool in the spindle.
        tool: int
        #: The tool length that is in effect, mm along X, Y and Z.
        tool_length_mm: List[float]

    class MoveEntry(Record):
        """A move as it is programmed."""
        #: `rapid`, `line`, `circle`, `thread` and so on.
        kind: str
        #: The position of the axes that are named, mm and degrees, in the program frame.
        target: Mapping[str, float]
        #: The tool axis if it is programmed as a vector. Unit: 1.
        direction: Optional[List[float]]
        #: The feed with its unit, or `rapid`.
        feed: str

    class FrameEntry(Record):
        """A program frame."""
        #: Rotation, scale and mirror of X, Y and Z, row by row. Unit: 1.
        linear: List[List[float]]
        #: Its origin: X Y Z A B C U V W, mm and degrees. Unit: mm or deg.
        shift: List[float]

    class NodeEntry(Record):
        """A point of the path."""
        #: The nominal tool in the workpiece frame.
        nominal: TraceDocument.ToolPoseEntry
        #: The actual tool there.
        actual: TraceDocument.ToolPoseEntry
        #: Actual − nominal.
        deviation: TraceDocument.PathDeviationEntry
        #: The positions of the axes, mm and degrees.
        axes: Mapping[str, float]
        #: The time since the start of the program, s.
        time_s: float

    class ToolPoseEntry(Record):
        """A tool in the workpiece frame."""
        #: Its tip, mm.
        tip_mm: List[float]
        #: Its axis from the tip to the spindle, a unit vector. Unit: 1.
        axis: List[float]

    class PathDeviationEntry(Record):
        """A deviation of the tool on its path."""
        #: Of the tip, µm.
        tip_um: List[float]
        #: Of the axis, µrad.
        axis_urad: List[float]
        #: Of the tip along the feed, µm.
        feed_um: float
        #: Of the tip along the principal normal of the path, µm.
        normal_um: float
        #: Of the tip along the binormal of the path, µm.
        binormal_um: float

    class TimeEntry(Record):
        """When a block runs."""
        #: Its start, s since the start of the program.
        from_s: float
        #: Its end, s.
        to_s: float
        #: The speed of the tip at its end, mm/min.
        speed_mm_per_min: float

    class ShareEntry(Record):
        """One error alone."""
        #: The ISO 230-1 name of the error; `EXX(scale)`, `workpiece` and the like for the parts of temperatures.
        error: str
        #: Of the tip, µm.
        tip_um: List[float]
        #: Of the axis, µrad.
        axis_urad: List[float]

    class BodyEntry(Record):
        """A body of the machine."""
        #: Its name.
        body: str
        #: Its nominal place in the machine frame.
        nominal: TraceDocument.PlaceEntry
        #: Its actual place there.
        actual: TraceDocument.PlaceEntry

    class PlaceEntry(Record):
        """The place of a body."""
        #: Its origin, mm.
        origin_mm: List[float]
        #: Its rotation, row by row. Unit: 1.
        rotation: List[List[float]]


class VerifyDocument(Record):
    """Readings compared with a prediction, or with other readings."""
    #: Which document this is.
    schema: Literal["trueaxis/verify/1"]
    #: The name of the comparison.
    name: str
    #: What the readings are compared with: `prediction` or `readings`.
    against: str
    #: How many readings.
    readings: int
    #: The coverage factor k of U = k·u. Unit: 1.
    coverage_factor: float
    #: The decision rule in words.
    rule: str
    #: `pass`, `fail` or `undecided`.
    verdict: str
    # ["pass"]: How many numbers pass.
    #: How many fail.
    fail: int
    #: How many are neither.
    undecided: int
    #: The share of all numbers within U.
    coverage: VerifyDocument.CoverageEntry
    #: By instrument.
    instruments: List[VerifyDocument.PartEntry]
    #: By place, the worst first.
    places: List[VerifyDocument.PlacePartEntry]
    #: What the readings make of what is stated of the set-up with an uncertainty.
    set_up: List[VerifyDocument.SetUpEntry]
    #: Every number.
    deviations: List[VerifyDocument.DifferenceEntry]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class CoverageEntry(Record):
        """A share of numbers within U."""
        #: How many numbers.
        numbers: int
        #: How many of them are within U.
        inside: int
        #: The number of independent ones: errors of the machine shift many readings at once. Unit: 1.
        independent: float
        #: `inside` over `numbers`. Unit: 1.
        share: float
        #: The 95 % interval of the share (Wilson). Unit: 1.
        interval_95: List[float]
        #: The share that is expected. Unit: 1.
        expected: float

    class PartEntry(Record):
        """The numbers of an instrument or a place. Its root mean squares are `rms_nominal_um` (nominal machine; null against readings) and `rms_um` (machine file, or between the two sets of readings), µm; `…_urad`, µrad, of an instrument that measures angles."""
        #: The name of the instrument.
        instrument: str
        #: The share within U.
        coverage: VerifyDocument.CoverageEntry
        #: The largest |deviation| / U; null where U is 0. Unit: 1.
        largest_ratio: Optional[float]

    class PlacePartEntry(Record):
        """The numbers of a place."""
        #: The name of the instrument.
        instrument: str
        #: The share within U.
        coverage: VerifyDocument.CoverageEntry
        #: The largest |deviation| / U; null where U is 0. Unit: 1.
        largest_ratio: Optional[float]
        #: The number of the place.
        group: int
        #: A line of the readings there.
        line: int

    class SetUpEntry(Record):
        """An unknown of the set-up: `deviation_um`, fitted − stated, and `u_um`, its standard uncertainty where machine file and statement are right; `…_urad`, `…_um_per_m`, `…_um_per_h` or `…_urad_per_h` by the kind of the unknown."""
        #: The name of the instrument.
        instrument: str
        #: The unknown.
        unknown: str
        #: Whether the readings contradict machine file and statement together: the verdict is `fail` then.
        is_contradicted: bool

    class DifferenceEntry(Record):
        """One number: `deviation_um`, measured − expected, and `expanded_um`, its U, in µm; `…_urad` in µrad."""
        #: The name of the instrument.
        instrument: str
        #: The line of its reading.
        line: int
        #: The channel of the instrument, from 0.
        channel: int


class VerifyPartDocument(Record):
    """Measured test pieces against their tolerances and their prediction."""
    #: Which document this is.
    schema: Literal["trueaxis/verify-part/1"]
    #: The name of the file.
    name: str
    #: The test piece.
    test_piece: str
    #: What the prediction is.
    prediction: str
    #: How many parts were measured.
    parts: int
    #: The coverage factor k of U = k·u. Unit: 1.
    coverage_factor: float
    #: The decision rule in words.
    rule: str
    #: `pass`, `fail` or `undecided`: the parts against their tolerances.
    verdict: str
    #: Why, in a sentence.
    reason: str
    #: Whether the parts were measured in the frame of the best fit.
    best_fit: bool
    #: Index after index.
    indices: List[VerifyPartDocument.PartIndexEntry]
    #: The circles of every section of every part that was measured by points.
    sections: List[VerifyPartDocument.PartSectionEntry]
    #: What the reader of the numbers should know.
    warnings: List[str]
    #: The problems found in the input; the command line prints them on standard error, too. May be absent.
    diagnostics: List[Mapping[str, Any]]

    class PartIndexEntry(Record):
        """One index."""
        #: Its key.
        index: str
        #: Whether it decides.
        decisive: bool
        #: The predicted value, mm.
        predicted_mm: Optional[float]
        #: Its standard uncertainty, mm; null if not stated.
        u_predicted_mm: Optional[float]
        #: What the noise of the points adds to the predicted index on average, mm; 0 if not known.
        noise_mm: float
        #: Part after part, mm.
        measured_mm: List[float]
        #: Their standard uncertainties, mm; null if not stated.
        u_measured_mm: Optional[List[float]]
        #: Mean of the parts, mm.
        mean_mm: Optional[float]
        #: Its standard uncertainty with the spread of the parts, mm.
        u_mean_mm: Optional[float]
        #: Predicted over measured mean (Fig 20 of Wu et al. 2022), %.
        ratio_percent: Optional[float]
        #: The same with the mean that the sheet prints, %; null if it prints none.
        printed_ratio_percent: Optional[float]
        #: |measured mean − predicted| over its expanded uncertainty; null where that is 0. Unit: 1.
        e_n: Optional[float]
        #: Whether both agree within their uncertainties.
        agrees: Optional[bool]
        #: Its limit, mm.
        tolerance_mm: Optional[float]
        #: Part after part `pass`, `fail` or `undecided`, where there is a limit.
        verdicts: List[str]
        #: What else is said about it.
        note: str

    class PartSectionEntry(Record):
        """One section of one part."""
        #: The number of the part, from 1.
        part: int
        #: The file of its points.
        file: str
        #: Height in the workpiece frame, mm.
        z_mm: float
        #: Height above the base, mm.
        height_mm: float
        #: Number of points.
        points: int
        #: Nominal radius, mm.
        nominal_radius_mm: float
        #: Radius of the least-squares circle, mm.
        radius_mm: float
        #: Centre of the least-squares circle, mm.
        centre_mm: List[float]
        #: Roundness about it, mm.
        roundness_lsc_mm: float
        #: Width of the minimum zone, mm.
        roundness_mzc_mm: float
        #: Width of the predicted minimum zone, mm; null without a study.
        predicted_roundness_mzc_mm: Optional[float]
        #: Azimuth of each point, deg.
        azimuth_deg: List[float]
        #: E of each point, mm; positive: material left.
        e_mm: List[float]
