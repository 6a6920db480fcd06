//! The command `conik` as its users meet it: what it prints, what it writes, and its exit status.

mod svg_frame;

mod command {
    mod bad_input;
    mod campaign;
    mod default_rules;
    mod documents;
    mod explain;
    mod export;
    mod gallery;
    mod gallery_pages;
    mod live;
    mod live_guard;
    mod monitors;
    mod network;
    mod outputs;
    mod pictures;
    mod process;
    mod run_folder;
    mod small_commands;
    mod strangers;
    mod terminal;
    mod trouble;
    mod urdf;
    mod view;
    mod watched;
}
