//! The language by examples, and programs that nobody would write.

use super::*;
use proptest::prelude::*;

/// A controller that only remembers.
#[derive(Debug)]
struct Notebook {
    floats: [f64; 48],
    integers: [f64; 48],
    booleans: [f64; 128],
    watchdogs: Vec<(String, f64, WatchdogAction)>,
    mounted: Vec<Vec<f64>>,
    said: Vec<String>,
}

impl Notebook {
    fn new() -> Self {
        Self {
            floats: [0.0; 48],
            integers: [0.0; 48],
            booleans: [0.0; 128],
            watchdogs: Vec::new(),
            mounted: Vec::new(),
            said: Vec::new(),
        }
    }
}

/// Inputs and outputs are the same registers.
impl Surroundings for Notebook {
    fn input(&self, kind: Register, address: usize) -> f64 {
        match kind {
            Register::Float => self.floats[address],
            Register::Integer => self.integers[address],
            Register::Boolean => self.booleans[address],
        }
    }

    fn output(&self, kind: Register, address: usize) -> f64 {
        self.input(kind, address)
    }

    fn write_output(&mut self, kind: Register, address: usize, value: f64) {
        assert!(value.is_finite());
        match kind {
            Register::Float => self.floats[address] = value,
            Register::Integer => self.integers[address] = value,
            Register::Boolean => self.booleans[address] = value,
        }
    }

    fn joints(&self, which: Joints) -> [f64; 6] {
        match which {
            Joints::ActualPositions => [1.0; 6],
            Joints::TargetPositions => [2.0; 6],
            Joints::ActualSpeeds => [3.0; 6],
            Joints::TargetSpeeds => [0.0; 6],
        }
    }

    fn cycle_s(&self) -> f64 {
        0.002
    }

    fn set_payload(&mut self, mass_kg: f64) {
        self.mounted.push(vec![mass_kg]);
    }

    fn set_tcp(&mut self, pose: [f64; 6]) {
        self.mounted.push(pose.to_vec());
    }

    fn set_watchdog(&mut self, input: &str, least_hz: f64, action: WatchdogAction) -> bool {
        self.watchdogs.push((input.to_owned(), least_hz, action));
        input.starts_with("input_")
    }

    fn say(&mut self, line: &str) {
        self.said.push(line.to_owned());
    }
}

/// Runs the statements of a program to the end, at most some hundred pauses.
fn run(statements: &str) -> Result<(Vec<Pause>, Notebook), ScriptError> {
    let text = format!("def test():\n{statements}\nend\n");
    let mut machine = Machine::new(&Program::parse(&text)?);
    let (mut pauses, mut notebook) = (Vec::new(), Notebook::new());
    while pauses.len() < 300 {
        match machine.run(&mut notebook)? {
            Pause::Ended => break,
            pause => pauses.push(pause),
        }
    }
    Ok((pauses, notebook))
}

/// What a program says by `textmsg`.
fn said(statements: &str) -> Vec<String> {
    run(statements).unwrap().1.said
}

fn fault(statements: &str) -> String {
    run(statements).unwrap_err().to_string()
}

#[test]
fn expressions_have_the_values_that_the_manual_gives() {
    for (expression, value) in [
        ("1+2-3", "0"),
        ("4.0*5/8", "2.5"),
        ("(1+2)*3/(4-5)", "-9.0"),
        ("7 / 2", "3.5"),
        ("-7 % 3", "-1"),
        ("True or False and (1 == 2)", "True"),
        ("not 42 >= 87 and 87 <= 42", "False"),
        ("True xor True", "False"),
        ("\"Hello\" != \"World!\" and 5.0 == 5", "True"),
        ("[1, 2.5, True, \"x\"]", "[1, 2.5, True, x]"),
        ("[1, 2] == [1.0, 2]", "True"),
        ("p[0.1, 0, 0, 0, 1, 0][4]", "1.0"),
        ("[[1, 2][1], 3][0]", "2"),
        ("floor(-1.5)", "-2"),
        ("ceil(1.2)", "2"),
        ("abs(-3)", "3"),
        ("norm([3, 4])", "5.0"),
        ("length(\"four\") + get_list_length([1])", "5"),
        ("to_str(0.5)", "0.5"),
        ("str_cat(\"a\", 1)", "a1"),
        ("d2r(180) == r2d(1)", "False"),
        ("sqrt(pow(3, 2)) + sin(0) + cos(0) - 1", "3.0"),
        ("get_actual_joint_positions()[5]", "1.0"),
        ("get_target_joint_positions()[5]", "2.0"),
        (
            "get_actual_joint_speeds()",
            "[3.0, 3.0, 3.0, 3.0, 3.0, 3.0]",
        ),
        ("is_steady()", "True"),
        ("get_steptime()", "0.002"),
    ] {
        assert_eq!(
            said(&format!("textmsg({expression})")),
            [value],
            "{expression}"
        );
    }
}

#[test]
fn branches_and_loops_take_the_ways_that_they_say() {
    let program = "
        i = 0
        while True:
          i = i + 1
          if i == 2:
            continue
          elif i == 3:
            textmsg(\"three\")
          elif i > 5:
            break
          else:
            textmsg(i) # a comment
          end
          j = 0
          while j < 2:
            j = j + 1
          end
        end
        textmsg(\"end \", i * 10 + j)";
    assert_eq!(said(program), ["1", "three", "4", "5", "end 62"]);
}

#[test]
fn functions_nest_recur_and_give_values() {
    let program = "
        def factorial(n):
          def less(n):
            return n - 1
          end
          if n <= 1:
            return 1
          end
          return n * factorial(less(n))
        end
        def change(list, to=0):
        end
        textmsg(factorial(10))";
    assert!(fault(program).contains("expected ',', found '='"));
    let program = program.replace(", to=0", "");
    assert_eq!(said(&program), ["3628800"]);
    assert_eq!(
        said("def a(x, y):\nreturn x - y\nend\ntextmsg(a(y=1, x=5))"),
        ["4"]
    );
    let hidden = "def a():\ndef b():\nend\nend\nb()";
    assert!(fault(hidden).contains("unknown function 'b'"));
    assert!(
        fault("a()\ndef a():\nend").contains("unknown function 'a'"),
        "it stands below"
    );
}

#[test]
fn variables_are_global_at_the_first_level_and_local_elsewhere() {
    let program = "
        a = 0
        def free():
          a = 1
          b = 1
        end
        def own():
          local a = 2
          def inner():
            a = 3
          end
          inner()
          return a
        end
        def new():
          global c = 4
        end
        free()
        textmsg(a)
        textmsg(own())
        textmsg(a)
        new()
        textmsg(c)";
    assert_eq!(said(program), ["1", "2", "3", "4"]);
    assert!(fault("def f():\nb = 1\nend\nf()\ntextmsg(b)").contains("unknown variable 'b'"));
    assert!(fault("if False:\nb = 1\nend\ntextmsg(b)").contains("'b' has no value yet"));
}

#[test]
fn lists_are_copied_by_assignment() {
    let program = "
        a = [1, 2]
        b = a
        b[0] = 5
        def f(list):
          list[1] = 7
          return list
        end
        textmsg(f(a))
        textmsg(a, b)
        c = p[0, 0, 0, 0, 0, 0]
        c[2] = 1
        textmsg(c)";
    let expected = ["[1, 7]", "[1, 2][5, 2]", "p[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]"];
    assert_eq!(said(program), expected);
}

#[test]
fn calls_that_take_time_are_the_only_pauses() {
    let (pauses, notebook) = run("
        def move(q):
          servoj(q, t=0.008, lookahead_time=0.05, gain=500)
          return 1
        end
        write_output_integer_register(3, 1 + move([1, 2, 3, 4, 5, 6.5]))
        servoj([0, 0, 0, 0, 0, 0], 1.4, 1.05)
        stopj(4)
        sleep(0.5)
        sleep(0)
        sync()
        write_output_float_register(4, read_output_integer_register(3))
        write_output_boolean_register(127, read_input_float_register(4) == 2)
        rtde_set_watchdog(\"input_int_register_0\", 10, \"stop\")
        rtde_set_watchdog(\"input_int_register_1\", 5)
        set_payload(1.5, [0, 0, 0.1])
        set_tcp(p[0, 0, 0.1, 0, 0, 0])
        popup(\"Hello\", title=\"T\")
        halt
        textmsg(\"never\")")
    .unwrap();
    let servoj = |target, time_s, lookahead_s, gain| Pause::Servoj {
        target,
        time_s,
        lookahead_s,
        gain,
    };
    let expected = [
        servoj([1.0, 2.0, 3.0, 4.0, 5.0, 6.5], 0.008, 0.05, 500.0),
        servoj([0.0; 6], 0.002, 0.1, 300.0),
        Pause::Stopj { deceleration: 4.0 },
        Pause::Sleep { time_s: 0.5 },
        Pause::Sync,
    ];
    assert_eq!(pauses, expected);
    assert_eq!(notebook.booleans[127], 1.0);
    let watchdogs = [
        (
            "input_int_register_0".to_owned(),
            10.0,
            WatchdogAction::Stop,
        ),
        (
            "input_int_register_1".to_owned(),
            5.0,
            WatchdogAction::Pause,
        ),
    ];
    assert_eq!(notebook.watchdogs, watchdogs);
    assert_eq!(
        notebook.mounted,
        [vec![1.5], vec![0.0, 0.0, 0.1, 0.0, 0.0, 0.0]]
    );
    assert_eq!(notebook.said, ["popup: Hello"]);
}

#[test]
fn what_is_not_emulated_is_refused_before_anything_runs() {
    for (statements, message) in [
        (
            "textmsg(1)\nmovej([0,0,0,0,0,0])",
            "line 3: unknown function 'movej'",
        ),
        (
            "if False:\nsocket_open(\"h\", 1)\nend",
            "unknown function 'socket_open'",
        ),
        (
            "def f():\nspeedj([0,0,0,0,0,0], 1)\nend",
            "unknown function 'speedj'",
        ),
        ("thread a():\nend", "threads are not emulated"),
        ("run a()", "threads are not emulated"),
        ("sleep()", "'t' is missing; its arguments are (t)"),
        ("sleep(1, 2)", "2 arguments are too many"),
        ("servoj([0], dt=1)", "there is no argument 'dt'"),
        ("sleep(1, t=1)", "'t' is given twice"),
        ("def sleep(t):\nend", "'sleep' exists already"),
        ("def f(a, a):\nend", "parameters of different names"),
        ("break", "'break' stands in no loop"),
        (
            "def f():\nend\nwhile True:\ndef g():\ncontinue\nend\nend",
            "'continue' stands in no",
        ),
    ] {
        let text = format!("def test():\n{statements}\nend\n");
        let error = Program::parse(&text).unwrap_err().to_string();
        assert!(error.contains(message), "{statements}: {error}");
    }
}

#[test]
fn faults_end_the_program_with_their_line() {
    for (statements, message) in [
        (
            "x = 1\ny = x[0]",
            "line 3: what has elements must be a list or a pose",
        ),
        ("x = [1][1]", "line 2: there is no element 1 among 1"),
        ("x = [1]\nx[-1] = 2", "no element -1"),
        ("x = 1 / 0", "the result of '/' is not a finite number"),
        ("x = 1e308 * 10", "the result of '*'"),
        ("x = sqrt(-1)", "the result of sqrt"),
        ("x = floor(1e10)", "the result of floor"),
        ("x = 2147483647 + 1", "the result of '+'"),
        (
            "x = True + 1",
            "an operand of '+' must be a number, and is a boolean",
        ),
        ("x = 1 == True", "must be an integer, and is a boolean"),
        (
            "if 1:\nend",
            "a condition must be a boolean, and is an integer",
        ),
        (
            "def f():\nend\nx = f()",
            "what a function gives must be a value",
        ),
        ("x = sync()", "what a function gives must be a value"),
        ("x = [[1]]", "an element of a list must be no list itself"),
        ("servoj([0, 0])", "servoj's q must be a list of six numbers"),
        (
            "servoj(p[0,0,0,0,0,0])",
            "servoj's q must be a list of six numbers, and is a pose",
        ),
        (
            "servoj([0,0,0,0,0,0], lookahead_time=0.02)",
            "servoj's lookahead_time is 0.02; it must lie within 0.03 and 0.2",
        ),
        (
            "servoj([0,0,0,0,0,0], gain=3000)",
            "servoj's gain is 3000; it must lie within 100 and",
        ),
        ("servoj([0,0,0,0,0,0], t=-1)", "servoj's t is -1"),
        ("sleep(-1)", "sleep's t is -1"),
        ("stopj(0)", "stopj's a is 0"),
        (
            "read_input_float_register(48)",
            "address is 48; it must lie within 0 and 47",
        ),
        (
            "read_input_float_register(1.5)",
            "address must be an integer, and is a float",
        ),
        (
            "write_output_integer_register(0, 0.5)",
            "value must be an integer",
        ),
        ("set_payload(-1)", "set_payload's m is -1"),
        ("rtde_set_watchdog(\"output_x\", 1)", "unknown 'output_x'"),
        ("rtde_set_watchdog(\"input_x\", 0)", "min_frequency is 0"),
        (
            "rtde_set_watchdog(\"input_x\", 1, \"bark\")",
            "action: unknown 'bark'",
        ),
        (
            "popup(\"x\", blocking=True)",
            "popups that wait for an answer are not emulated",
        ),
        ("while True:\nend", "a loop that never waits"),
        ("while True:\nsleep(0)\nend", "a loop that never waits"),
        (
            "def f():\nf()\nend\nf()",
            "the depth of calls is limited to 50",
        ),
        (
            "s = \"xxxxxxxxxxxxxxxx\"\nwhile True:\ns = str_cat(s, s)\nend",
            "a text's size in bytes is limited",
        ),
    ] {
        let error = fault(statements);
        assert!(error.contains(message), "{statements}: {error}");
    }
}

#[test]
fn a_program_that_is_over_stays_over() {
    for (text, is_fault) in [("x = 1", false), ("x = 1 / 0", true), ("halt", false)] {
        let mut machine = Machine::new(&Program::parse(text).unwrap());
        assert_eq!(machine.run(&mut Notebook::new()).is_err(), is_fault);
        assert_eq!(machine.run(&mut Notebook::new()), Ok(Pause::Ended));
    }
}

#[test]
fn secondary_programs_take_no_time() {
    let program = Program::parse("sec a():\n  write_output_integer_register(0, 1)\nend").unwrap();
    assert!(program.is_secondary());
    let error = Program::parse("sec a():\n  sleep(1)\nend").unwrap_err();
    assert!(error.to_string().contains("'sleep' takes time"), "{error}");
}

/// Parses a text and, if it is a program, runs it for some pauses.
fn survive(text: &str) {
    if let Ok(program) = Program::parse(text) {
        let mut machine = Machine::new(&program);
        let mut notebook = Notebook::new();
        for _ in 0..20 {
            if !matches!(machine.run(&mut notebook), Ok(pause) if pause != Pause::Ended) {
                break;
            }
        }
    }
}

/// The words of the language and some that are not.
const WORDS: [&str; 74] = [
    "def f(a):\n",
    "def test():\n",
    "end\n",
    "if ",
    "elif ",
    "else:\n",
    "while ",
    "break\n",
    "continue\n",
    "return ",
    "halt\n",
    "pass\n",
    "global ",
    "local ",
    ":\n",
    "\n",
    "(",
    ")",
    "[",
    "]",
    "p[",
    ",",
    " = ",
    "+",
    "-",
    "*",
    "/",
    "%",
    "==",
    "!=",
    "<",
    "<=",
    " and ",
    " or ",
    " xor ",
    "not ",
    "True",
    "False",
    "0",
    "1",
    "5",
    "47",
    "2147483647",
    "0.5",
    "1e300",
    "\"t\"",
    "a",
    "b",
    "q",
    "f(",
    "f(a=",
    "sleep(",
    "sync()\n",
    "servoj(",
    "stopj(",
    "textmsg(",
    "to_str(",
    "str_cat(",
    "sqrt(",
    "pow(",
    "floor(",
    "abs(",
    "norm(",
    "length(",
    "set_payload(",
    "set_tcp(",
    "read_input_float_register(",
    "write_output_integer_register(",
    "rtde_set_watchdog(",
    "a = [0, 0, 0, 0, 0, 0]\n",
    "a[0] = a[5] + 1\n",
    "servoj(a, t=0.008)\n",
    "while a < 5:\n",
    "# \"\n",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn no_text_brings_the_interpreter_down(text in any::<String>()) {
        survive(&text);
        survive(&format!("def test():\n{text}\nend\n"));
    }

    #[test]
    fn no_row_of_words_brings_the_interpreter_down(
        words in prop::collection::vec(prop::sample::select(&WORDS[..]), 0..60),
    ) {
        survive(&words.concat());
        survive(&format!("def test():\n{}\nend\n", words.concat()));
    }

    /// The servo program, with words put in, left out and exchanged.
    #[test]
    fn no_change_of_a_real_program_brings_the_interpreter_down(
        changes in prop::collection::vec(
            (any::<prop::sample::Index>(), 0..3_u8, prop::sample::select(&WORDS[..])),
            1..6,
        ),
    ) {
        let text = crate::program::tests::PROGRAM.text().unwrap();
        let mut words: Vec<&str> = text.split_inclusive(|c: char| !c.is_alphanumeric()).collect();
        for (place, change, word) in changes {
            let place = place.index(words.len());
            match change {
                0 => { words.remove(place); }
                1 => words.insert(place, word),
                _ => words[place] = word,
            }
        }
        survive(&words.concat());
    }
}
