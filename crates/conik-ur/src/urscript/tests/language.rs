//! The language by examples.

use super::*;

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
