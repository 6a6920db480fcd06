//! throwaway
#[test]
fn draw() {
    for dir in std::env::var("RUNS").unwrap_or_default().split_whitespace() {
        conik_cli::figure::write_all(std::path::Path::new(dir)).unwrap();
        conik_cli::report::write(std::path::Path::new(dir)).unwrap();
    }
}
