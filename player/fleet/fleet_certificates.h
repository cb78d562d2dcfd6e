#pragma once

// Certificates of a fleet (X.509, with keys on the curve P-256): an authority of its own, which
// signs those of the broker and of devices.

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "shared/core/status.h"

struct evp_pkey_st;
struct x509_st;

namespace lararium::player {

// A certificate and its private key, as PEM.
struct CertificateFiles {
  std::string certificate;
  std::string key;
};

class CertificateAuthority {
 public:
  // Makes a new one. name: its common name.
  static Result<CertificateAuthority> Make(const std::string& name);
  // where: name of the files in errors.
  static Result<CertificateAuthority> Parse(const CertificateFiles& files, std::string_view where);

  CertificateFiles files() const;
  // A certificate for a server at an IP address or name.
  Result<CertificateFiles> MakeServer(const std::string& host) const;
  // A certificate for a client; the broker takes the name as that of its user.
  Result<CertificateFiles> MakeClient(const std::string& name) const;

 private:
  struct Free {
    void operator()(evp_pkey_st* key) const;
    void operator()(x509_st* certificate) const;
  };
  using Key = std::unique_ptr<evp_pkey_st, Free>;
  using Certificate = std::unique_ptr<x509_st, Free>;
  struct Wish;

  CertificateAuthority(Certificate certificate, Key key)
      : certificate_(std::move(certificate)), key_(std::move(key)) {}
  static Certificate Sign(const Wish& wish, evp_pkey_st* key, x509_st* issuer, evp_pkey_st* signer);
  Result<CertificateFiles> Issue(const Wish& wish) const;

  Certificate certificate_;
  Key key_;
};

// A password of 20 letters and digits (100 bits) that cannot be mistaken for each other.
Result<std::string> MakePassword();
// A line of Mosquitto's password file: PBKDF2 with SHA-512 and a random salt.
Result<std::string> PasswordLine(std::string_view user, std::string_view password);

}  // namespace lararium::player
