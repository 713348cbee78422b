//! Against the formulas of the documents, over random poses. The right-hand sides are written out
//! from the papers with sines, cosines and plain products; errata.md says where a print is wrong.

// The worst residual of each law is worth seeing.
#![allow(clippy::print_stdout)]

mod library;

use library::{Random, machine_of};
use trueaxis_geometry::frame::Point;
use trueaxis_geometry::{Mat3, Vec3};
use trueaxis_machine::Machine;
use trueaxis_machine::axis::Command;
use trueaxis_machine::errors::{BodyErrors, ErrorValues};

/// Poses per law; every one is compared, the worst is judged.
const POSES: usize = 10_000;
/// How many changed machines the poses are spread over.
const MACHINES: usize = 20;
const NEAR_MM: f64 = 1e-9;
const NEAR: f64 = 1e-12;

/// The worst differences of a law.
#[derive(Default)]
struct Worst {
    mm: f64,
    axis: f64,
}

impl Worst {
    fn mm(&mut self, ours: Vec3, theirs: Vec3) {
        assert!((ours - theirs).iter().all(|d| d.is_finite()));
        self.mm = self.mm.max((ours - theirs).amax());
    }

    fn axis(&mut self, ours: Vec3, theirs: Vec3) {
        assert!((ours - theirs).iter().all(|d| d.is_finite()));
        self.axis = self.axis.max((ours - theirs).amax());
    }

    fn judge(&self, law: &str) {
        println!("{law}: {:.1e} mm, {:.1e}", self.mm, self.axis);
        assert!(self.mm < NEAR_MM && self.axis < NEAR, "{law}: {:e} {:e}", self.mm, self.axis);
    }
}

fn rx(a: f64) -> Mat3 {
    Mat3::new(1.0, 0.0, 0.0, 0.0, a.cos(), -a.sin(), 0.0, a.sin(), a.cos())
}

fn ry(b: f64) -> Mat3 {
    Mat3::new(b.cos(), 0.0, b.sin(), 0.0, 1.0, 0.0, -b.sin(), 0.0, b.cos())
}

fn rz(c: f64) -> Mat3 {
    Mat3::new(c.cos(), -c.sin(), 0.0, c.sin(), c.cos(), 0.0, 0.0, 0.0, 1.0)
}

fn text_mm(v: Vec3) -> String {
    format!("{} {} {} mm", v.x, v.y, v.z)
}

/// The command by the letter of its axis.
fn named(machine: &Machine, command: &Command, letter: char) -> f64 {
    let axis = machine.axes().iter().position(|a| a.name.letter() == letter);
    command[axis.expect("an axis of that letter")]
}

fn nominal(machine: &Machine, command: &Command) -> (Vec3, Vec3) {
    let at = machine.deviation(command, &ErrorValues::default());
    (at.nominal_tip.vector(), at.nominal_axis.vector())
}

// ---------------------------------------------------------------- Lei and Hsu 2003

/// The mill of Lei and Hsu 2003 with other dimensions, and (X0, Y0, Z0) and (X1, Y1, Z1) of its Eq 1.
/// The programmed point is the tip: 180 mm below the probe, so that Zm is the command of Z.
fn lei_hsu(random: &mut Random) -> (Machine, Vec3, Vec3) {
    let (p0, p1) = (random.vector(200.0), random.vector(400.0));
    let machine = machine_of("lei-hsu-mill", |text| {
        let changed = text.replace("60 40 120 mm", &text_mm(p0));
        changed.replace("250 200 -350 mm", &text_mm(p1))
    });
    (machine.with_tip(Vec3::new(0.0, 0.0, -180.0)), p0, p1)
}

/// Lei and Hsu 2003 Eq 1–10, with the minus signs of errata 004-1 and the table that turns by +a, +c
/// (004-3).
#[test]
fn paper_004_eq_1_to_10() {
    let mut random = Random(4);
    let (mut eq1, mut eq2, mut eq5, mut eq8) =
        (Worst::default(), Worst::default(), Worst::default(), Worst::default());
    for _ in 0..MACHINES {
        let (machine, p0, p1) = lei_hsu(&mut random);
        for _ in 0..POSES / MACHINES {
            let command = random.command(&machine);
            let get = |letter| named(&machine, &command, letter);
            let machine_point = Vec3::new(get('X'), get('Y'), get('Z'));
            let ((sa, ca), (sc, cc)) = (get('A').sin_cos(), get('C').sin_cos());
            let (tip, axis) = nominal(&machine, &command);

            // Eq 1: Trans(X1) Rot(x, a) Rot(z, c) Trans(X0)
            eq1.mm(machine_point, p1 + rx(get('A')) * (rz(get('C')) * (p0 + tip)));
            // Eq 2–4
            let [dx, dy, dz] = (machine_point - p1).into();
            let workpiece_point = Vec3::new(
                sc * sa * dz + sc * ca * dy + cc * dx - p0.x,
                cc * sa * dz + cc * ca * dy - sc * dx - p0.y,
                ca * dz - sa * dy - p0.z,
            );
            eq2.mm(tip, workpiece_point);
            // Eq 5–7
            eq5.axis(axis, Vec3::new(sa * sc, sa * cc, ca));
            // Eq 8–10
            let [x, y, z] = (p0 + tip).into();
            let back = Vec3::new(
                x * cc - y * sc + p1.x,
                x * ca * sc + y * ca * cc - z * sa + p1.y,
                x * sa * sc + y * sa * cc + z * ca + p1.z,
            );
            eq8.mm(machine_point, back);
        }
    }
    eq1.judge("004 Eq 1");
    eq2.judge("004 Eq 2-4");
    eq5.judge("004 Eq 5-7");
    eq8.judge("004 Eq 8-10");
}

/// Lei and Hsu 2003 Eq 11–13: both (a, c) from (I, J, K), with the quadrant of errata 004-4 and the
/// well-conditioned form of 004-6.
#[test]
fn paper_004_eq_11_to_13() {
    let mut random = Random(411);
    let (machine, ..) = lei_hsu(&mut random);
    let mut worst = Worst::default();
    for _ in 0..POSES {
        let command = random.command(&machine);
        let (a, c) = (named(&machine, &command, 'A'), named(&machine, &command, 'C'));
        let [i, j, k] = nominal(&machine, &command).1.into();
        let tilt = f64::hypot(i, j).atan2(k);
        let (found_a, found_c) = if a > 0.0 {
            (tilt, i.atan2(j)) // a > 0
        } else {
            (-tilt, (-i).atan2(-j)) // a < 0
        };
        // As printed: arccos has half the digits, arctan the angle but for half turns.
        assert!((found_a.abs() - k.acos()).abs() < 1e-7);
        // Near the pole c loses what sin a loses.
        let off = (rz(found_c) - rz(c)).amax();
        worst.axis(Vec3::new(found_a - a, off * a.sin(), 0.0), Vec3::zeros());
        assert!(((i / j).atan() - c).tan().abs() * a.sin().abs() < 1e-9);
    }
    worst.judge("004 Eq 11-13");
}

// ---------------------------------------------------------------- Zhang et al. 2023

/// Zhang et al. 2023 Eq 1–3; h of the text is d of the equations (errata 003-1), coordinates relative
/// to O_R, ISO senses (003-2); and the tool axis of 003-3.
#[test]
fn paper_003_eq_1_to_3() {
    let mut random = Random(3);
    let mut worst = Worst::default();
    for _ in 0..MACHINES {
        let d = random.within(80.0);
        let place = format!("placement = \"0 0 {d} mm\"");
        let machine =
            machine_of("i5-engraver", |text| text.replace("placement = \"0 0 35 mm\"", &place));
        for _ in 0..POSES / MACHINES {
            let command = random.command(&machine);
            let get = |letter| named(&machine, &command, letter);
            let (tip, axis) = nominal(&machine, &command);
            let ((sa, ca), (sc, cc)) = (get('A').sin_cos(), get('C').sin_cos());
            let [x, y, z] = tip.into();
            let machine_point = Vec3::new(
                x * cc + y * sc,
                -x * sc * ca + y * cc * ca + z * sa + d * sa,
                x * sc * sa - y * cc * sa + z * ca + d * ca,
            );
            worst.mm(Vec3::new(get('X'), get('Y'), get('Z')), machine_point);
            worst.axis(axis, rz(get('C')) * (rx(get('A')) * Vec3::z()));
        }
    }
    worst.judge("003 Eq 1-3");
}

// ---------------------------------------------------------------- Wu et al. 2022

/// The frustum of Fig 5 on the gantry, with the A axis beside the C axis (errata 000-5) and a
/// workpiece that is itself out of place; all by changes of the shipped text.
struct Gantry {
    machine: Machine,
    beta: f64,
    gamma: f64,
    /// The bracket of Eq 2: part zero in the frame of the fixture before γ.
    bracket: Vec3,
    r_p: Vec3,
    /// p1 … p6 and r_t.
    p: [Vec3; 6],
    r_t: Vec3,
}

fn gantry(random: &mut Random) -> Gantry {
    let (beta_deg, gamma_deg) = (random.within(40.0), random.within(180.0));
    let (beta, gamma) = (beta_deg.to_radians(), gamma_deg.to_radians());
    let [h1, h2, h3, l1] = [60.0, 25.0, 25.0, 310.0].map(|size| size * (1.0 + random.unit()));
    let bracket =
        Vec3::new((h1 + h2) * beta.sin(), 0.0, h3 + l1 * beta.sin() / 2.0 + (h1 + h2) * beta.cos());
    let (p5, p6) = (random.vector(60.0), Vec3::new(0.0, 0.0, -200.0));
    let changes = [
        ("turn Z 0 deg", format!("turn Z {gamma_deg} deg")),
        ("shift 14.760095101689078 0 135.62412654441187 mm", text_mm(bracket)),
        ("turn Y 10 deg", format!("turn Y {beta_deg} deg")),
        ("placement = \"0 0 0 mm\"", format!("placement = \"{}\"", text_mm(p5))),
        ("EX0w = \"0 ", "EX0w = \"14 ".into()),
        ("EZ0w = \"0 ", "EZ0w = \"-23 ".into()),
        ("EA0w = \"0 ", "EA0w = \"57 ".into()),
        ("EB0w = \"0 ", "EB0w = \"-41 ".into()),
        ("EC0w = \"0 ", "EC0w = \"88 ".into()),
        ("[machine]", "[machine]\nrotation = \"small-angle\"".into()),
    ];
    let machine = machine_of("xkas2525", |text| {
        changes.iter().fold(text, |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        })
    });
    Gantry {
        machine,
        beta,
        gamma,
        bracket,
        r_p: Vec3::new(3100.0, 1250.0, -1200.0),
        p: [
            Vec3::new(0.0, -1500.0, 300.0),
            Vec3::new(0.0, 1500.0, -150.0),
            Vec3::new(0.0, 0.0, -250.0),
            Vec3::new(0.0, 0.0, 100.0),
            p5,
            p6,
        ],
        r_t: Vec3::new(0.0, 0.0, -100.0),
    }
}

impl Gantry {
    /// Eq 8: the linear axes at the tool-setting point with C = A = 0.
    fn setting_point(&self) -> Vec3 {
        self.r_p + rz(self.gamma) * self.bracket - self.p.iter().sum::<Vec3>() - self.r_t
    }

    fn errors(&self, command: &Command) -> ErrorValues {
        self.machine.errors_at(command, &[0.0; 6]).expect("within the tables")
    }

    /// R_t of Eq 1 with S34^s, S45^s (errata 000-1) and the shifts of C and A (000-2) in the
    /// moving frame, term by term; and the actual tool axis, the same product on e_z.
    fn eq_1(&self, command: &Command) -> (Vec3, Vec3) {
        let [_, x, y, z, c, a, t, _] = self.errors(command).bodies;
        let [p1, p2, p3, p4, p5, p6] = self.p;
        let (s1, s2, s3) = (Vec3::x() * command[0], Vec3::y() * command[1], Vec3::z() * command[2]);
        let (s34, s45) = (rz(command[3]), rx(command[4]));

        let in_spindle = p6 + pe(&t) + s_pe(&t) * self.r_t;
        let on_a = p5 + pe(&a) + s_pe(&a) * (s45 * (se(&a) + s_se(&a) * in_spindle));
        let on_c = p4 + pe(&c) + s_pe(&c) * (s34 * (se(&c) + s_se(&c) * on_a));
        let on_z = p3 + pe(&z) + s_pe(&z) * (s3 + se(&z) + s_se(&z) * on_c);
        let on_y = p2 + pe(&y) + s_pe(&y) * (s2 + se(&y) + s_se(&y) * on_z);
        let tip = p1 + pe(&x) + s1 + se(&x) + s_se(&x) * on_y;

        let tool = s_pe(&t) * Vec3::z();
        let tool = s_pe(&c) * (s34 * (s_se(&c) * (s_pe(&a) * (s45 * (s_se(&a) * tool)))));
        let tool = s_se(&x) * (s_pe(&y) * (s_se(&y) * (s_pe(&z) * (s_se(&z) * tool))));
        (tip, tool)
    }

    /// R_w of Eq 2 in the machine frame.
    fn eq_2(&self, r_w: Vec3, w: &BodyErrors) -> Vec3 {
        let in_fixture = self.bracket + ry(self.beta) * r_w;
        self.r_p + pe(w) + s_pe(w) * (rz(self.gamma) * in_fixture)
    }
}

/// p_e: the location shifts.
fn pe(e: &BodyErrors) -> Vec3 {
    Vec3::new(e.location.0[0], e.location.0[1], e.location.0[2])
}

/// s_e: the shifts of the error motions.
fn se(e: &BodyErrors) -> Vec3 {
    Vec3::new(e.motion.0[0], e.motion.0[1], e.motion.0[2])
}

/// S^pe and S^se: `I + [ε]×` as below Eq 3.
fn small([a, b, c]: [f64; 3]) -> Mat3 {
    Mat3::new(1.0, -c, b, c, 1.0, -a, -b, a, 1.0)
}

fn s_pe(e: &BodyErrors) -> Mat3 {
    small([e.location.0[3], e.location.0[4], e.location.0[5]])
}

fn s_se(e: &BodyErrors) -> Mat3 {
    small([e.motion.0[3], e.motion.0[4], e.motion.0[5]])
}

/// Wu et al. 2022 Eq 2: a point of the part in the machine frame.
#[test]
fn paper_000_eq_2() {
    let mut random = Random(2);
    let mut worst = Worst::default();
    for _ in 0..MACHINES {
        let gantry = gantry(&mut random);
        for _ in 0..POSES / MACHINES {
            let command = random.command(&gantry.machine);
            let errors = gantry.errors(&command);
            let bed_from_workpiece = gantry.machine.body_poses(&command, &errors)[0];
            let r_w = random.vector(300.0);
            let ours = bed_from_workpiece * Point::from_vector(r_w);
            worst.mm(ours.vector(), gantry.eq_2(r_w, &errors.bodies[0]));
        }
    }
    worst.judge("000 Eq 2");
}

/// Wu et al. 2022 Eq 8: at (x0, y0, z0, 0, 0) the nominal tip stands on part zero.
#[test]
fn paper_000_eq_8() {
    let mut random = Random(8);
    let mut worst = Worst::default();
    for _ in 0..MACHINES {
        let gantry = gantry(&mut random);
        let [x, y, z] = gantry.setting_point().into();
        worst.mm(nominal(&gantry.machine, &[x, y, z, 0.0, 0.0, 0.0]).0, Vec3::zeros());
    }
    worst.judge("000 Eq 8");
}

/// Wu et al. 2022 Eq 9 and 10 with y0, z0 (errata 000-4) and the term (Rz(C) − I) p5 (000-5); Eq 11
/// as v = Rz(C) Rx(A) e_z (000-6).
#[test]
fn paper_000_eq_9_to_11() {
    let mut random = Random(9);
    let (mut eq9, mut eq10, mut eq11) = (Worst::default(), Worst::default(), Worst::default());
    for _ in 0..MACHINES {
        let gantry = gantry(&mut random);
        let (p5, arm) = (gantry.p[4], gantry.p[5] + gantry.r_t);
        for _ in 0..POSES / MACHINES {
            let command = random.command(&gantry.machine);
            let [x, y, z, c, a, _] = command;
            let relative = Vec3::new(x, y, z) - gantry.setting_point();
            let (tip, n) = nominal(&gantry.machine, &command);
            // Eq 9
            let beside = rz(c) * p5 - p5;
            let turned = relative + rz(c) * (rx(a) * arm) - arm + beside;
            eq9.mm(tip, ry(gantry.beta).transpose() * (rz(gantry.gamma).transpose() * turned));
            // Eq 10, its matrix as printed
            let ((sa, ca), (sc, cc)) = (a.sin_cos(), c.sin_cos());
            let turn = Mat3::new(
                cc - 1.0,
                -sc * ca,
                sc * sa,
                sc,
                cc * ca - 1.0,
                -cc * sa,
                0.0,
                sa,
                ca - 1.0,
            );
            let onto_part = rz(gantry.gamma) * (ry(gantry.beta) * tip);
            eq10.mm(relative, onto_part - turn * arm - beside);
            // Eq 11
            let v = rz(gantry.gamma) * (ry(gantry.beta) * n);
            eq11.axis(v, Vec3::new(sc * sa, -cc * sa, ca));
        }
    }
    eq9.judge("000 Eq 9");
    eq10.judge("000 Eq 10");
    eq11.judge("000 Eq 11");
}

/// Wu et al. 2022 Eq 12 and 13 with errata 000-7 (`arccos v_Z`, better as atan2) and 000-8 (quadrant
/// by the sign of A): they return the commanded angles up to whole turns of C.
#[test]
fn paper_000_eq_12_and_13() {
    let mut random = Random(12);
    let gantry = gantry(&mut random);
    let mut worst = Worst::default();
    for _ in 0..POSES {
        let command = random.command(&gantry.machine);
        let [_, _, _, c, a, _] = command;
        let n = nominal(&gantry.machine, &command).1;
        let v = rz(gantry.gamma) * (ry(gantry.beta) * n);
        let sign = a.signum();
        let found_a = sign * v.x.hypot(v.y).atan2(v.z);
        assert!((found_a.abs() - v.z.acos()).abs() < 1e-7);
        let found_c = (sign * v.x).atan2(-sign * v.y);
        let turns = ((c - found_c) / std::f64::consts::TAU).round();
        assert!((-1.0..=1.0).contains(&turns), "the travel is ±360 deg");
        let off = c - found_c - turns * std::f64::consts::TAU;
        // Near A = 0 the angle C loses what sin A loses.
        worst.axis(Vec3::new(found_a - a, off * a.sin(), 0.0), Vec3::zeros());
        // As printed: −arctan(v_X / v_Y) but for half turns.
        assert!((-(v.x / v.y).atan() - c).tan().abs() * a.sin().abs() < 1e-9);
    }
    worst.judge("000 Eq 12, 13");
}

/// Wu et al. 2022 Eq 1 and 3–7: actual tip and tool axis with all errors in small angles and the
/// moving frame (errata 000-1, 000-2, 000-3), and the actual position after tool setting, in which
/// p1 and p1e drop out.
#[test]
fn paper_000_eq_1_and_5_to_7() {
    let mut random = Random(1);
    let (mut eq1, mut eq7) = (Worst::default(), Worst::default());
    let mut largest: f64 = 0.0;
    for _ in 0..MACHINES {
        let gantry = gantry(&mut random);
        let machine = &gantry.machine;
        let [x, y, z] = gantry.setting_point().into();
        let setting = [x, y, z, 0.0, 0.0, 0.0];
        let (tip_0, _) = gantry.eq_1(&setting);
        let actual = |command: &Command| {
            let at = machine.deviation(command, &gantry.errors(command));
            (at.nominal_tip.vector() + at.tip_mm, at.nominal_axis.vector() + at.axis, at.tip_mm)
        };
        for _ in 0..POSES / MACHINES {
            let command = random.command(machine);
            let (tip, axis, deviation) = actual(&command);
            largest = largest.max(deviation.norm());
            let w = gantry.errors(&command).bodies[0];
            let (r_t, tool) = gantry.eq_1(&command);
            // Eq 1 = Eq 2, seen from the machine.
            eq1.mm(gantry.eq_2(tip, &w), r_t);
            let bed_axis = s_pe(&w) * (rz(gantry.gamma) * (ry(gantry.beta) * axis));
            eq1.axis(bed_axis.normalize(), tool.normalize());
            // Eq 7
            let turn = s_pe(&w).try_inverse().expect("near identity");
            let back = ry(gantry.beta).transpose() * rz(gantry.gamma).transpose() * turn;
            eq7.mm(tip - actual(&setting).0, back * (r_t - tip_0));
        }
    }
    assert!(largest > 0.05, "the errors are at work: {largest} mm");
    eq1.judge("000 Eq 1");
    eq7.judge("000 Eq 7");
}
