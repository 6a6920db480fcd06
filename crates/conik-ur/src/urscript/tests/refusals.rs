//! What is refused before it runs, and what ends a program.

use super::*;

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
