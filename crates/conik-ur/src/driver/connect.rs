//! Opens a TCP connection on which nothing waits for ever.

use super::config::UrConfig;
use super::fault;
use conik_sim::arm::ArmError;
use std::net::{TcpStream, ToSocketAddrs};

/// A connection to a port of the controller, without delay for small packages.
pub(super) fn connect(config: &UrConfig, port: u16) -> Result<TcpStream, ArmError> {
    let failed = |error: &dyn std::fmt::Display| {
        let detail = format!(
            "no connection to {}:{port}: {error}; is the controller on, the address right, and the \
             port not blocked?",
            config.host
        );
        ArmError::new(fault::CONNECT_FAILED, detail)
    };
    let addresses = (config.host.as_str(), port)
        .to_socket_addrs()
        .map_err(|error| failed(&error))?;
    let mut last = failed(&"the name has no address");
    for address in addresses {
        match TcpStream::connect_timeout(&address, config.connect_timeout) {
            Ok(stream) => {
                stream
                    .set_nodelay(true)
                    .and_then(|()| stream.set_read_timeout(Some(config.link_timeout)))
                    .and_then(|()| stream.set_write_timeout(Some(config.link_timeout)))
                    .map_err(|error| failed(&error))?;
                return Ok(stream);
            }
            Err(error) => last = failed(&error),
        }
    }
    Err(last)
}
