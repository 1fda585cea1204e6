"""The class report: what the gradebook tells (statistics), its pictures (plots), its page and tables (page)."""
