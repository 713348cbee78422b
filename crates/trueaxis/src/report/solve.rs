//! Axis positions for a tool pose.

use trueaxis_machine::describe::to_shown;
use trueaxis_machine::{Machine, Solutions};
use trueaxis_report::numbers::fixed;
use trueaxis_report::{Report, Section, Table};

/// All solutions as text and page.
pub fn solve_report(machine: &Machine, solved: &Solutions) -> Report<'static> {
    let axes = machine.axes().iter().map(|axis| axis.name.to_string());
    let numbers = (1..).map(|n: u32| n.to_string());
    let headings = ["".to_owned()].into_iter().chain(axes);
    let headings = headings.chain(["rotary travel, deg".to_owned(), String::new()]);
    let rows = solved.solutions.iter().zip(numbers).map(|(solution, number)| {
        let positions = solution.command.iter().take(machine.axes().len()).enumerate();
        let mut row = vec![number];
        row.extend(positions.map(|(i, q)| fixed(to_shown(machine, i, *q), 6)));
        row.push(fixed(solution.rotary_travel_rad.to_degrees(), 6));
        row.push(if solution.within_travel { "" } else { "outside the travel" }.to_owned());
        row
    });
    let table = Table::new(headings).rows(rows);
    let section = Section::new("Axis positions, mm and degrees").table(table);
    Report::new(machine.name()).line(machine.chain_text()).section(match &solved.singular {
        Some(singular) => section.paragraph(format!("singular pose: {singular}")),
        None => section,
    })
}
