//! The table of corrections inside a control, and the subprogram that applies it to a hit.
//!
//! ```text
//!     θ = atan2(Δy, Δx)        i = ⌊θ/δ⌋        s = θ/δ − i        δ = 360°/n
//!     dR(θ) = (1 − s)·dR_i + s·dR_{i+1}         x = p − dR(θ)·u    docs/model.md eq. 190
//! ```
//!
//! p is the spindle at the trigger, Δ the way of the touch, u its direction; dR_n = dR_0 closes the turn. FANUC and
//! HAAS keep the table in #800 ff., LinuxCNC in #1000 ff., SINUMERIK in R100 ff. (machine data 28050 must allow as many
//! R parameters); HEIDENHAIN has no parameters that are counted through, so that its table stands in the subprogram
//! itself, one label for each step.
//!
//! # Source
//! Zhang et al. 2023, 2.3.2 (4) and 3.1: the deviation by direction, subtracted in x and y. Between the directions: linear.

use super::words::{Value, assign};
use trueaxis_nc::Control;

/// The first variable of the table.
const FANUC_FIRST: usize = 800;
const LINUXCNC_FIRST: usize = 1000;
const SINUMERIK_FIRST: usize = 100;
/// Where the tables end: #999; LinuxCNC #4999; HEIDENHAIN labels.
const FANUC_MOST: usize = 199;
const MOST: usize = 720;
const HEIDENHAIN_FIRST_LABEL: usize = 101;
/// Digits after the point, mm.
const DECIMALS: usize = 5;
/// Shorter ways have no direction, mm.
const LEAST_WAY_MM: f64 = 0.01;

/// What corrects hits.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    /// dR by direction, from 0 on evenly around, mm.
    pub dr_mm: Vec<f64>,
    /// Length of the probe at the trigger, mm, if it is known.
    pub length_mm: Option<f64>,
    /// In words, for the head of the files.
    pub about: String,
}

impl Correction {
    /// dR between the directions of the table, as the control computes it, mm; θ in rad.
    ///
    /// docs/model.md eq. 190
    pub fn dr_at(&self, direction_rad: f64) -> f64 {
        let n = self.dr_mm.len();
        if n == 0 {
            return 0.0;
        }
        let place = (direction_rad / std::f64::consts::TAU).rem_euclid(1.0) * n as f64;
        let (i, s) = (place.floor() as usize % n, place.fract());
        (1.0 - s) * self.dr_mm[i] + s * self.dr_mm[(i + 1) % n]
    }

    /// The files of the control: names and contents. Too many directions have no place: why.
    pub(super) fn files(&self, control: Control) -> Result<Vec<(String, String)>, String> {
        let n = self.dr_mm.len();
        let most =
            if matches!(control, Control::Fanuc | Control::Haas) { FANUC_MOST } else { MOST };
        if n > most {
            return Err(format!(
                "a table of {n} directions has no place in the variables of this control: {most} at most (table_steps)"
            ));
        }
        Ok(match control {
            Control::Fanuc | Control::Haas => vec![
                ("O7060.nc".to_owned(), self.fanuc()),
                ("O7061.nc".to_owned(), self.fanuc_table()),
            ],
            Control::LinuxCnc => vec![
                ("trueaxis_correct.ngc".to_owned(), self.linuxcnc()),
                ("trueaxis_table.ngc".to_owned(), self.linuxcnc_table()),
            ],
            Control::Sinumerik840d => vec![
                ("TRUEAXIS_CORRECT.SPF".to_owned(), self.sinumerik()),
                ("TRUEAXIS_TABLE.SPF".to_owned(), self.sinumerik_table()),
            ],
            Control::Heidenhain => vec![("TRUEAXIS_CORRECT.H".to_owned(), self.heidenhain())],
        })
    }

    /// The table with its first value again at the end.
    fn closed(&self) -> impl Iterator<Item = f64> + '_ {
        self.dr_mm.iter().chain(self.dr_mm.first()).map(|v| v + 0.0)
    }

    fn fanuc(&self) -> String {
        let (n, first, second) = (self.dr_mm.len(), FANUC_FIRST, FANUC_FIRST + 1);
        let [x, y, dr] = [Value::X, Value::Y, Value::Dr].map(|v| v.name(Control::Fanuc));
        format!(
            "%\nO7060 (TRUEAXIS CORRECTION BY DIRECTION)\n({about})\n\
             (A B: THE HIT. I J: THE WAY TO IT. RESULT: {x} {y} CORRECTED, {dr} SUBTRACTED)\n\
             #14=SQRT[#4*#4+#5*#5]\nIF[#14GE{LEAST_WAY_MM}]GOTO1\n#3000=2(THE HIT HAS NO DIRECTION)\nN1\n\
             #10=ATAN[#5]/[#4]\nIF[#10GE0]GOTO2\n#10=#10+360.\nN2\n\
             #11=#10*{n}./360.\n#12=FIX[#11]\nIF[#12LT{n}]GOTO3\n#12=0\n#11=#11-{n}.\nN3\n#13=#11-#12\n\
             {dr}=#[{first}+#12]+#13*[#[{second}+#12]-#[{first}+#12]]\n\
             {x}=#1-{dr}*#4/#14\n{y}=#2-{dr}*#5/#14\nM99\n%\n",
            about = plain(&self.about)
        )
    }

    fn fanuc_table(&self) -> String {
        let rows = self.closed().zip(FANUC_FIRST..).map(|(v, i)| format!("#{i}={v:.DECIMALS$}\n"));
        let rows: String = rows.collect();
        format!(
            "%\nO7061 (TRUEAXIS TABLE OF CORRECTIONS, MM)\n({})\n{rows}M99\n%\n",
            plain(&self.about)
        )
    }

    fn linuxcnc(&self) -> String {
        let (n, first, second) = (self.dr_mm.len(), LINUXCNC_FIRST, LINUXCNC_FIRST + 1);
        let [x, y, dr] = [Value::X, Value::Y, Value::Dr].map(|v| v.name(Control::LinuxCnc));
        format!(
            "({about})\n(#1 #2: the hit; #3 #4: the way to it)\no<trueaxis_correct> sub\n\
             #5 = [SQRT[#3*#3+#4*#4]]\no101 if [#5 LT {LEAST_WAY_MM}]\n(ABORT, the hit has no direction)\no101 endif\n\
             #6 = [ATAN[#4]/[#3]]\no102 if [#6 LT 0]\n#6 = [#6+360]\no102 endif\n\
             #7 = [#6*{n}/360]\n#8 = [FIX[#7]]\no103 if [#8 GE {n}]\n#8 = 0\n#7 = [#7-{n}]\no103 endif\n\
             #9 = [#7-#8]\n{dr} = [#[{first}+#8]+#9*[#[{second}+#8]-#[{first}+#8]]]\n\
             {x} = [#1-{dr}*#3/#5]\n{y} = [#2-{dr}*#4/#5]\no<trueaxis_correct> endsub\nM2\n",
            about = plain(&self.about)
        )
    }

    fn linuxcnc_table(&self) -> String {
        let rows = self.closed().zip(LINUXCNC_FIRST..);
        let rows: String = rows.map(|(v, i)| format!("#{i} = {v:.DECIMALS$}\n")).collect();
        format!(
            "({})\no<trueaxis_table> sub\n{rows}o<trueaxis_table> endsub\nM2\n",
            plain(&self.about)
        )
    }

    fn sinumerik(&self) -> String {
        let (n, first, second) = (self.dr_mm.len(), SINUMERIK_FIRST, SINUMERIK_FIRST + 1);
        let of = |v: Value| v.name(Control::Sinumerik840d);
        let [hx, hy, wx, wy] = [Value::HitX, Value::HitY, Value::WayX, Value::WayY].map(of);
        let [x, y, dr] = [Value::X, Value::Y, Value::Dr].map(of);
        format!(
            "; {about}\n; {hx} {hy}: the hit, {wx} {wy}: the way to it; result: {x} {y} corrected, {dr} subtracted\n\
             R96=SQRT({wx}*{wx}+{wy}*{wy})\nIF R96<{LEAST_WAY_MM}\nSETAL(65002,\"THE HIT HAS NO DIRECTION\")\nM0\nENDIF\n\
             R97=ATAN2({wy},{wx})\nIF R97<0\nR97=R97+360\nENDIF\nR98=R97*{n}/360\nR99=TRUNC(R98)\nIF R99>={n}\nR99=0\n\
             R98=R98-{n}\nENDIF\n{dr}=R[{first}+R99]+(R98-R99)*(R[{second}+R99]-R[{first}+R99])\n\
             {x}={hx}-{dr}*{wx}/R96\n{y}={hy}-{dr}*{wy}/R96\nM17\n",
            about = plain(&self.about)
        )
    }

    fn sinumerik_table(&self) -> String {
        let rows = self.closed().zip(SINUMERIK_FIRST..);
        let rows: String = rows.map(|(v, i)| format!("R{i}={v:.DECIMALS$}\n")).collect();
        format!("; {}\n{rows}M17\n", plain(&self.about))
    }

    fn heidenhain(&self) -> String {
        let n = self.dr_mm.len();
        let of = |v: Value| v.name(Control::Heidenhain);
        let [hx, hy, wx, wy] = [Value::HitX, Value::HitY, Value::WayX, Value::WayY].map(of);
        let dr = of(Value::Dr);
        let mut lines = vec![
            "BEGIN PGM TRUEAXIS_CORRECT MM".to_owned(),
            format!("; {}", plain(&self.about)),
            format!("; {hx} {hy}: the hit, {wx} {wy}: the way to it"),
            format!("Q46 = SQRT ( {wx} * {wx} + {wy} * {wy} )"),
            format!("FN 12: IF +Q46 LT +{LEAST_WAY_MM} GOTO LBL 90"),
            format!("FN 13: Q47 = +{wy} ANG +{wx}"),
            format!("Q48 = Q47 * {n} / 360"),
            format!("FN 12: IF +Q48 LT +{n} GOTO LBL 91"),
            format!("Q48 = Q48 - {n}"),
            "LBL 91".to_owned(),
        ];
        let label = |i: usize| HEIDENHAIN_FIRST_LABEL + i;
        lines.extend((1..n).map(|i| format!("FN 12: IF +Q48 LT +{i} GOTO LBL {}", label(i - 1))));
        lines.push(format!("FN 9: IF +0 EQU +0 GOTO LBL {}", label(n - 1)));
        let values: Vec<f64> = self.closed().collect();
        for (i, pair) in values.windows(2).enumerate() {
            let [a, b] = [pair[0], pair[1]];
            lines.push(format!("LBL {}", label(i)));
            lines.push(format!(
                "{dr} = ( {a:+.DECIMALS$} ) + ( Q48 - {i} ) * ( ( {b:+.DECIMALS$} ) - ( {a:+.DECIMALS$} ) )"
            ));
            lines.push("FN 9: IF +0 EQU +0 GOTO LBL 92".to_owned());
        }
        lines.push("LBL 92".to_owned());
        for (to, hit, way) in [(Value::X, &hx, &wx), (Value::Y, &hy, &wy)] {
            lines.push(assign(Control::Heidenhain, to, &format!("{hit} - {dr} * {way} / Q46")));
        }
        lines.extend(
            ["FN 9: IF +0 EQU +0 GOTO LBL 93", "LBL 90", "; THE HIT HAS NO DIRECTION", "STOP"]
                .map(str::to_owned),
        );
        lines.extend(
            ["FN 14: ERROR=1014", "LBL 93", "END PGM TRUEAXIS_CORRECT MM"].map(str::to_owned),
        );
        let numbered = lines.iter().enumerate().map(|(i, l)| format!("{i} {l}\n"));
        numbered.collect()
    }
}

/// What may stand in a comment of any control.
fn plain(text: &str) -> String {
    let kept = |c: char| match c {
        ' '..='~' if !"()%;~\"[]".contains(c) => c,
        'µ' => 'u',
        _ => ' ',
    };
    text.chars().take(90).map(kept).collect::<String>().to_ascii_uppercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_two_directions_the_table_is_a_line() {
        let table = Correction {
            dr_mm: vec![0.010, 0.020, 0.000, -0.010],
            length_mm: None,
            about: String::new(),
        };
        // 90° steps: half way from 90° to 180°, and a quarter from 270° to 360°.
        assert!((table.dr_at(135_f64.to_radians()) - 0.010).abs() < 1e-12);
        assert!((table.dr_at(292.5_f64.to_radians()) + 0.005).abs() < 1e-12);
        assert!((table.dr_at((-67.5_f64).to_radians()) + 0.005).abs() < 1e-12);
    }
}
