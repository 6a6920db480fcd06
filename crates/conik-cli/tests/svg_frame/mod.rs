//! Reads the SVG files that the figures write, as far as it takes to tell where each mark is.

use conik_cli::figure::lettering;

/// A mark may reach beyond the picture by this much [px]: half a line, or letters that are wider than thought.
const SLACK: f64 = 4.0;

/// What in a picture is no number, or is outside of it.
pub fn faults(svg: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let mut moves: Vec<(f64, f64)> = vec![(0.0, 0.0)];
    let (mut width, mut height) = (0.0, 0.0);
    for element in svg.split('<').skip(1) {
        let (tag, text) = element.split_once('>').unwrap_or((element, ""));
        let name = tag.split([' ', '/', '>']).next().unwrap_or_default();
        let numbers = Numbers { tag };
        let here = moves.last().copied().unwrap_or_default();
        match name {
            "svg" => (width, height) = (numbers.one("width"), numbers.one("height")),
            "g" => {
                let shift = numbers.of("transform");
                let shift = (
                    shift.first().copied().unwrap_or_default(),
                    shift.get(1).copied().unwrap_or_default(),
                );
                moves.push((here.0 + shift.0, here.1 + shift.1));
            }
            "" if tag.starts_with("/g") => {
                moves.pop();
            }
            _ => {}
        }
        // Colours are defined in parts of what they fill.
        if matches!(
            name,
            "g" | "svg" | "stop" | "radialGradient" | "linearGradient"
        ) {
            continue;
        }
        if ["NaN", "inf"]
            .iter()
            .any(|word| numbers.values().any(|value| value.contains(word)))
        {
            faults.push(format!("no number: <{tag}>"));
        }
        for (x, y) in numbers.points(name, text) {
            let (x, y) = (x + here.0, y + here.1);
            let inside =
                (-SLACK..=width + SLACK).contains(&x) && (-SLACK..=height + SLACK).contains(&y);
            if !inside {
                faults.push(format!(
                    "({x:.1}, {y:.1}) of {width} x {height}: <{tag}>{text}"
                ));
                break;
            }
        }
    }
    faults
}

/// The attributes of an element.
struct Numbers<'a> {
    tag: &'a str,
}

impl Numbers<'_> {
    fn values(&self) -> impl Iterator<Item = &str> {
        // What a picture shows is told in words in its label.
        let attributes = self.tag.split("=\"").zip(self.tag.split("=\"").skip(1));
        let measured = attributes.filter(|(name, _)| !name.ends_with("aria-label"));
        measured.map(|(_, rest)| rest.split('"').next().unwrap_or_default())
    }

    fn text(&self, attribute: &str) -> &str {
        let start = format!(" {attribute}=\"");
        let value = self.tag.split_once(&start).map(|(_, rest)| rest);
        value
            .and_then(|rest| rest.split('"').next())
            .unwrap_or_default()
    }

    /// Every number in an attribute.
    fn of(&self, attribute: &str) -> Vec<f64> {
        let is_no_part = |c: char| !c.is_ascii_digit() && !matches!(c, '.' | '-');
        let numbers = self.text(attribute).split(is_no_part);
        numbers.filter_map(|number| number.parse().ok()).collect()
    }

    fn one(&self, attribute: &str) -> f64 {
        self.of(attribute).first().copied().unwrap_or_default()
    }

    /// Points as far out as the mark reaches.
    fn points(&self, name: &str, text: &str) -> Vec<(f64, f64)> {
        let around = |(x, y): (f64, f64), (a, b): (f64, f64)| {
            vec![
                (x - a, y - b),
                (x + a, y - b),
                (x - a, y + b),
                (x + a, y + b),
            ]
        };
        let local = match name {
            "line" => vec![
                (self.one("x1"), self.one("y1")),
                (self.one("x2"), self.one("y2")),
            ],
            "rect" => {
                let (x, y) = (self.one("x"), self.one("y"));
                vec![(x, y), (x + self.one("width"), y + self.one("height"))]
            }
            "circle" => {
                let radius = self.one("r");
                around((self.one("cx"), self.one("cy")), (radius, radius))
            }
            // Turned, it reaches less far than its corners do.
            "ellipse" => vec![(0.0, 0.0), (0.0, self.one("ry")), (0.0, -self.one("ry"))],
            "polygon" => self
                .of("points")
                .chunks_exact(2)
                .map(|it| (it[0], it[1]))
                .collect(),
            "path" => path(self.text("d")),
            "text" => {
                let wide = lettering::width(text, self.one("font-size"));
                let (x, y) = (self.one("x"), self.one("y"));
                let left = match self.text("text-anchor") {
                    "middle" => x - wide / 2.0,
                    "end" => x - wide,
                    _ => x,
                };
                if self.text("transform").is_empty() {
                    vec![(left, y), (left + wide, y - self.one("font-size") * 0.7)]
                } else {
                    vec![(x, y - wide / 2.0), (x, y + wide / 2.0)]
                }
            }
            _ => Vec::new(),
        };
        match self.of("transform")[..] {
            [x, y, turn] if name != "text" => {
                let (sin, cos) = turn.to_radians().sin_cos();
                let turned = |(a, b): (f64, f64)| (x + a * cos - b * sin, y + a * sin + b * cos);
                local.into_iter().map(turned).collect()
            }
            _ => local,
        }
    }
}

/// The corners of a path, and of arcs their ends.
fn path(d: &str) -> Vec<(f64, f64)> {
    let mut points: Vec<(f64, f64)> = Vec::new();
    for step in d
        .split_inclusive(|c: char| c.is_ascii_alphabetic())
        .collect::<Vec<_>>()
        .windows(2)
    {
        let command = step[0].chars().last().unwrap_or('Z');
        let numbers: Vec<f64> = step[1]
            .split([' ', ','])
            .map(|number| number.trim_end_matches(|c: char| c.is_ascii_alphabetic()))
            .filter_map(|number| number.parse().ok())
            .collect();
        match (command, &numbers[..]) {
            ('M' | 'L', [x, y]) | ('A', [_, _, _, _, _, x, y]) => points.push((*x, *y)),
            ('H', [x]) => points.push((*x, points.last().map_or(0.0, |it| it.1))),
            ('V', [y]) => points.push((points.last().map_or(0.0, |it| it.0), *y)),
            _ => panic!("unknown step `{command}` {numbers:?} in {d}"),
        }
    }
    points
}
