//! What is no robot is refused, with its place, what is wrong and what would be right.

use conik_urdf::{Options, Place, UrdfError, read};

/// A sound arm, of which each case spoils one thing.
const ARM: &str = r#"<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="upper"/>
  <link name="lower"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/>
    <child link="upper"/>
    <origin xyz="0 0 0.3" rpy="0 0 1.5"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="2" velocity="3" effort="40"/>
  </joint>
  <joint name="elbow" type="prismatic">
    <parent link="upper"/>
    <child link="lower"/>
    <axis xyz="1 0 0"/>
    <limit lower="0" upper="0.5" velocity="1" effort="9"/>
    <mimic joint="shoulder" multiplier="2" offset="0.1"/>
  </joint>
</robot>
"#;

fn refusal(text: &str, tools: &[&str]) -> UrdfError {
    let options = Options {
        base: None,
        tools: tools.iter().map(|&tool| tool.to_owned()).collect(),
    };
    match read(text, &options) {
        Ok(_) => panic!("it was read: {text}"),
        Err(error) => error,
    }
}

#[test]
fn the_sound_arm_is_read() {
    let described = read(ARM, &Options::default()).expect("it is right");
    assert_eq!(described.robot.dof(), 1);
    assert_eq!(described.efforts, [Some(40.0)]);
    // The follower reaches its 0 at the shoulder's -0.05, and its 0.5 at 0.2; its speed 1 at 0.5.
    let limits = described.robot.joints()[0].limits;
    assert_eq!(limits.position, Some((-0.05, 0.2)));
    assert_eq!(limits.speed, Some(0.5));
}

/// What is replaced, by what, the line of the error, and what it must say.
#[rustfmt::skip]
const CASES: &[(&str, &str, usize, &[&str])] = &[
    ("<robot name=\"arm\">", "<robots name=\"arm\">", 20, &["</robot>", "<robots>"]),
    ("type=\"revolute\"", "type=\"hinge\"", 6, &["joint \"shoulder\", attribute `type`", "\"hinge\"", "revolute"]),
    ("type=\"revolute\"", "type=\"Revolute\"", 6, &["unknown type", "known types"]),
    (" type=\"revolute\"", "", 6, &["attribute `type`: missing", "type="]),
    ("type=\"revolute\"", "type=\"floating\"", 6, &["joint \"shoulder\"", "more than one direction"]),
    ("type=\"revolute\"", "type=\"planar\"", 6, &["more than one direction", "another base|choose a base"]),
    ("<link name=\"upper\"/>", "<link/>", 4, &["link, attribute `name`: missing"]),
    ("<link name=\"upper\"/>", "<link name=\" \"/>", 4, &["attribute `name`: is empty"]),
    ("<link name=\"upper\"/>", "<link name=\"base\"/>", 4, &["link \"base\"", "is taken", "line 3"]),
    ("name=\"elbow\"", "name=\"shoulder\"", 13, &["joint \"shoulder\"", "is taken", "line 6"]),
    ("<joint name=\"elbow\"", "<joint", 13, &["joint, attribute `name`: missing"]),
    ("<parent link=\"upper\"/>", "<parent link=\"uper\"/>", 14, &["there is no link \"uper\""]),
    ("<child link=\"lower\"/>", "<child link=\"\"/>", 15, &["attribute `link`: is empty"]),
    ("<child link=\"lower\"/>", "<child/>", 15, &["attribute `link`: missing", "<child link="]),
    ("<child link=\"lower\"/>", "", 13, &["joint \"elbow\": `<child>` is missing"]),
    ("<parent link=\"upper\"/>", "", 13, &["`<parent>` is missing"]),
    ("<parent link=\"upper\"/>", "<parent link=\"upper\"/><parent link=\"base\"/>", 14, &["a second `<parent>`"]),
    ("<child link=\"lower\"/>", "<child link=\"upper\"/>", 13, &["two parents", "\"shoulder\"", "line 6"]),
    ("<parent link=\"base\"/>", "<parent link=\"lower\"/>", 13, &["circle"]),
    ("<parent link=\"upper\"/>", "<parent link=\"lower\"/>", 13, &["circle"]),
    ("  <link name=\"lower\"/>", "  <link name=\"lower\"/><link name=\"loose\"/>", 5, &["link \"loose\": no joint carries it", "\"base\" in line 3"]),
    ("xyz=\"0 0 0.3\"", "xyz=\"0 0\"", 9, &["origin of joint \"shoulder\", attribute `xyz`", "three numbers, found 2"]),
    ("xyz=\"0 0 0.3\"", "xyz=\"0 0 1 2\"", 9, &["found 4"]),
    ("xyz=\"0 0 0.3\"", "xyz=\"0 0 0,3\"", 9, &["\"0,3\" is not a number", "decimal point"]),
    ("xyz=\"0 0 0.3\"", "xyz=\"\"", 9, &["found 0"]),
    ("rpy=\"0 0 1.5\"", "rpy=\"0 0 nan\"", 9, &["`rpy`", "\"nan\" is not a finite number"]),
    ("rpy=\"0 0 1.5\"", "rpy=\"0 0 pi\"", 9, &["\"pi\" is not a number"]),
    ("xyz=\"0 0 0.3\"", "xyz=\"0 0 1e999\"", 9, &["not a finite number"]),
    ("xyz=\"0 0 0.3\"", "xyz=\"0 0 1e300\"", 9, &["out of range"]),
    ("rpy=\"0 0 1.5\"", "quat_xyzw=\"0 0 1\"", 9, &["origin of joint", "`quat_xyzw`", "four numbers, found 3", "0 0 0 1"]),
    ("rpy=\"0 0 1.5\"", "quat_xyzw=\"0 0 0 0\"", 9, &["no orientation"]),
    ("rpy=\"0 0 1.5\"", "rpy=\"0 0 1.5\" quat_xyzw=\"0 0 0 1\"", 9, &["`rpy` gives the orientation already"]),
    ("xyz=\"0 0 1\"", "xyz=\"0 0 0\"", 10, &["axis of joint \"shoulder\"", "no direction"]),
    ("lower=\"-1\"", "lower=\"3\"", 11, &["limit of joint \"shoulder\", attribute `lower`", "greater than `upper`"]),
    ("upper=\"2\"", "upper=\"two\"", 11, &["attribute `upper`", "\"two\" is not a number"]),
    ("velocity=\"3\"", "acceleration=\"fast\"", 11, &["attribute `acceleration`", "\"fast\" is not a number"]),
    ("velocity=\"3\"", "velocity=\"inf\"", 11, &["attribute `velocity`", "not a finite"]),
    ("upper=\"2\"", "upper=\"2\" upper=\"3\"", 11, &["`upper` is given twice"]),
    ("joint=\"shoulder\"", "joint=\"sholder\"", 18, &["mimic of joint \"elbow\"", "not there"]),
    ("joint=\"shoulder\"", "joint=\"elbow\"", 18, &["circle"]),
    (" joint=\"shoulder\"", "", 18, &["attribute `joint`: missing"]),
    ("multiplier=\"2\"", "multiplier=\"x\"", 18, &["attribute `multiplier`"]),
    ("type=\"revolute\"", "type=\"fixed\"", 2, &["no joint moves \"lower\""]),
    ("<robot name=\"arm\">", "<robot name=\"arm\" xmlns:xacro=\"http://ros.org/wiki/xacro\"><xacro:arm/>", 2, &["xacro", "xacro FILE"]),
    ("  <link name=\"upper\"/>", "  <xacro:link/>", 4, &["this is xacro", "xacro FILE"]),
    ("xyz=\"0 0 0.3\"", "xyz=\"0 0 ${height}\"", 9, &["this is xacro"]),
    ("link=\"base\"", "link=\"$(arg base)\"", 7, &["this is xacro"]),
    ("<robot name=\"arm\">", "<robot name=\"arm\"><macro name=\"leg\"/>", 2, &["this is xacro"]),
    ("  <link name=\"upper\"/>", "  <gz:link/>", 4, &["prefix \"gz\" is not declared"]),
    ("<robot name=\"arm\">", "<!DOCTYPE robot [<!ENTITY a \"b\">]><robot name=\"arm\">", 2, &["document type declaration", "remove"]),
    ("<robot name=\"arm\">", "<robot name=\"arm\"><!-- a -- b -->", 2, &["comment"]),
    ("name=\"upper\"", "name=\"up&per\"", 4, &["no XML"]),
    ("</robot>", "", 19, &["ends within an element"]),
    ("</robot>", "</robot><robot/>", 20, &["no XML"]),
];

#[test]
fn each_mistake_is_named_with_its_place() {
    let mut wrong = Vec::new();
    for (good, bad, line, says) in CASES {
        assert!(ARM.contains(good), "{good}");
        let error = refusal(&ARM.replacen(good, bad, 1), &[]);
        let message = error.to_string();
        let Place::Text { line: found, .. } = error.place else {
            panic!("{bad}: no place in {message}");
        };
        let is_said = |said: &&str| said.split('|').any(|said| message.contains(said));
        if found != *line || !says.iter().all(is_said) || error.help.is_empty() {
            wrong.push(format!(
                "{bad} in line {line} is to say {says:?}: {message}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_is_no_description_is_refused() {
    for (text, says) in [
        ("", "empty"),
        ("\u{feff}", "empty"),
        ("  \n ", "empty"),
        ("hello", "no XML"),
        (
            "\n<?xml version=\"1.0\"?><robot name=\"a\"/>",
            "before the XML declaration",
        ),
        (
            "<!-- a --><?xml version=\"1.0\"?><robot name=\"a\"/>",
            "before the XML declaration",
        ),
        ("<robot name=\"a\"/>", "there is no link"),
        (
            "<robot name=\"a\"><link name=\"l\"/></robot>",
            "there is no joint",
        ),
        ("<sdf/>", "SDF"),
        ("<html/>", "found `<html>`"),
        ("<robot", "no whole element"),
        ("\u{0}\u{1}", "no XML"),
    ] {
        let message = refusal(text, &[]).to_string();
        let any = says.split('|').any(|said| message.contains(said));
        assert!(any, "{text:?}: {message}");
    }
    assert!(read(&format!("\u{feff}{ARM}"), &Options::default()).is_ok());
}

#[test]
fn a_tree_with_several_ends_needs_a_tool() {
    let fork = ARM.replace("<parent link=\"upper\"/>", "<parent link=\"base\"/>");
    let error = refusal(&fork, &[]);
    assert_eq!(error.place, Place::Tools);
    assert!(
        error.to_string().contains("\"upper\", \"lower\""),
        "{error}"
    );
    assert!(
        refusal(&fork, &["hand"])
            .to_string()
            .contains("there is no link \"hand\"")
    );
    assert!(
        refusal(&fork, &["base"])
            .to_string()
            .contains("is the base")
    );
    let options = Options {
        base: Some("floor".to_owned()),
        tools: Vec::new(),
    };
    assert_eq!(
        read(&fork, &options).expect_err("no such base").place,
        Place::Base
    );
}

/// A chain of so many links, each joint of it `inside`.
fn chain(links: usize, inside: &str) -> String {
    let mut text = String::from("<robot name=\"chain\"><link name=\"l0\"/>");
    for i in 1..=links {
        let before = i - 1;
        let inside = inside.replace("{before}", &before.to_string());
        text += &format!(
            "<link name=\"l{i}\"/><joint name=\"j{i}\" type=\"continuous\"><parent link=\"l{before}\"/>\
             <child link=\"l{i}\"/>{inside}</joint>"
        );
    }
    text + "</robot>"
}

#[test]
fn thirty_two_joints_are_read_and_more_refused() {
    let robot = read(&chain(32, ""), &Options::default())
        .expect("it is right")
        .robot;
    assert_eq!(robot.dof(), 32);
    let message = refusal(&chain(33, ""), &[]).to_string();
    assert!(
        message.contains("33 joints") && message.contains("32"),
        "{message}"
    );
    assert!(
        refusal(&chain(20_000, ""), &[])
            .to_string()
            .contains("20000 joints")
    );
}

#[test]
fn immense_texts_come_to_an_end() {
    let deep = "<robot name=\"r\">".to_owned() + &"<a>".repeat(200_000) + &"</a>".repeat(200_000);
    refusal(&(deep + "</robot>"), &[]);
    refusal(&"<robot>".repeat(300_000), &[]);
    let wide = "<robot name=\"r\">".to_owned() + &"<a/>".repeat(600_000) + "</robot>";
    assert!(refusal(&wide, &[]).to_string().contains("more than 500000"));
    let attributes: String = (0..300_000).map(|i| format!(" a{i}=\"1\"")).collect();
    let message = refusal(
        &ARM.replacen("<axis", &format!("<axis{attributes}"), 1),
        &[],
    );
    assert!(
        message
            .to_string()
            .starts_with("line 10, column 5: the element has 300001 attributes"),
        "{message}"
    );
    let declared: String = (0..30_000)
        .map(|i| format!("<a xmlns:n{i}=\"u\">"))
        .collect();
    let nested = ARM.replace(
        "</robot>",
        &(declared + &"</a>".repeat(30_000) + "</robot>"),
    );
    let message = refusal(&nested, &[]).to_string();
    assert!(message.contains("more than 1000 namespaces"), "{message}");
    let strange: String = (0..100_000).map(|i| format!("<a{i}/>")).collect();
    read(
        &ARM.replace("</robot>", &(strange + "</robot>")),
        &Options::default(),
    )
    .expect("it is right");
    let leaves: String = (0..60_000)
        .map(|i| {
            format!(
                "<link name=\"a{i}\"/><joint name=\"b{i}\" type=\"fixed\"><parent link=\"base\"/>\
                 <child link=\"a{i}\"/></joint>"
            )
        })
        .collect();
    let lower = Options {
        base: None,
        tools: vec!["lower".to_owned()],
    };
    read(&ARM.replace("</robot>", &(leaves + "</robot>")), &lower).expect("it is right");
    let circle =
        chain(20_000, "<mimic joint=\"j{before}\"/>").replace("joint=\"j0\"", "joint=\"j20000\"");
    assert!(refusal(&circle, &[]).to_string().contains("circle"));
    let laughs = format!(
        "<!DOCTYPE r [<!ENTITY a \"{}\">]><robot name=\"&a;\"/>",
        "x".repeat(1000)
    );
    assert!(refusal(&laughs, &[]).to_string().contains("document type"));
    let long = ARM.replace("\"base\"", &format!("\"{}\"", "b".repeat(100_000)));
    let message = refusal(&long, &[]).to_string();
    assert!(
        message.len() < 2000 && message.contains("100000 bytes long"),
        "{message}"
    );
}

#[test]
fn what_looks_like_attributes_and_is_none_is_not_counted() {
    let equations = "a=\"b\" <c d='e' xmlns:f=\"g\"/>".repeat(2000);
    let within = format!("<!-- {equations} --><![CDATA[ {equations} ]]><?x {equations} ?>");
    let quoted = format!("<visual name='{}'/>", "x=y > ".repeat(2000));
    let text = ARM.replacen(
        "<link name=\"base\"/>",
        &format!("<link name=\"base\">{within}{quoted}</link>"),
        1,
    );
    read(&text, &Options::default()).expect("it is right");
}
